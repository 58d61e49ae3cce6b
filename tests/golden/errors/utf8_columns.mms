// Columns count characters, also after those of several bytes.
const a = "äöü 漢字" + nope;
//                   ^^^^ error E0201: unknown name `nope`
/* é́ */ const b = nada;
//                  ^^^^ error E0201: unknown name `nada`
