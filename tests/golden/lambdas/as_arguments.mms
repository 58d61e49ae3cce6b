// Functions take functions: lambdas, #names and #operators.
real apply(function(real) -> real f, real x) = f(x);
real both(function(real, real) -> real f) = f(5, 3);
const a = apply(function(x) -> 2 * x + 1, 3);              // expect: 7
const b = apply(#sqrt, 9.0);                               // expect: 3
const c = both(#+) + both(#-) + both(#*) + both(#/);       // expect: 26.666666666666667
const d = both(#%) + both(#^);                             // expect: 127
const g = apply(#-, 4.0);                                  // expect: -4
const h = both(#atan2);                                    // expect: 1.0303768265243125
