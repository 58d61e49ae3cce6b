// A type that is not there.
real f(pont p) = 1;
//     ^^^^ error E0215
const thing k = 1;
//    ^^^^^ error E0215
