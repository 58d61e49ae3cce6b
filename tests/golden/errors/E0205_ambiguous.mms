// Two candidates that fit equally well.
real f(real x, integer n) = 1;
real f(integer n, real x) = 2;
const a = f(1, 2);
//        ^^^^^^^ error E0205
