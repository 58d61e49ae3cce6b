// So is the call of a function value.
real apply(function(real) -> real f, real x) = f(x);
const a = apply(function(x) -> x + true, 1);
//                             ^^^^^^^^ error E0206: `apply` is called here
