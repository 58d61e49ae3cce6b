// A tab is one character.
const a =		nope;
//         ^^^^ error E0201: unknown name `nope`
