// A function has a `return`.
real f(real x)
    y = 2 * x;
   surface s end
// ^^^^^^^ error E0124: `f`
