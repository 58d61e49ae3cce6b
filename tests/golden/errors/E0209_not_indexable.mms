// Only arrays have elements.
real f(real x) = x[0];
//               ^^^^ error E0209
const m = [1, 2];
const a = m[0, 1];
//        ^^^^^^^ error E0209
