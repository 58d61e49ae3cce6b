// A comment that is never closed.
const a = 1;
//             vv error E0106
const b = 2;   /* and so on
