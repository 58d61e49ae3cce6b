// A function says the type of its value.
   f(real x) = 2 * x;
// ^ error E0128: `f`
