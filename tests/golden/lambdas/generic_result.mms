// The result type of a lambda is inferred at the call.
generic T apply(function(real) -> generic T f, real x) = f(x);
const a = apply(function(x) -> [x, 2 * x], 3);     // expect: [3, 6]
const b = apply(function(x) -> x > 2, 3);          // expect: true
