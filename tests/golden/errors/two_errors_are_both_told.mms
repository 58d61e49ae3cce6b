// An error does not hide the next one, and is not told twice.
const a = nope + nada;
//        ^^^^ error E0201
//               ^^^^ error E0201
const b = a + 1;
real f(real x) = b + nil;
//                   ^^^ error E0201
