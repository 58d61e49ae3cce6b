// A named argument that no formal has.
real f(real x) = x;
const a = f(y = 1);
//        ^^^^^^^^ error E0204: it has no argument `y`
