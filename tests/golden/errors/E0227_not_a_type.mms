// A name that is no type where one is wanted.
const k = 3;
real f(k x) = 1;
//     ^ error E0227
