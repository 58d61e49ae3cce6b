// A lambda in a machine function captures its arguments.
real apply(function(real) -> real f, real x) = f(x);
real go(real x, integer n) = select x, if n == 0; go(apply(function(t) -> t * 2 + n, x), n - 1) otherwise end;
real a() = go(1, integer(3 * $position.z));                                  // expect: 25
