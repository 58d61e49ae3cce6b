// A recursion left for the machine may hand a function down unchanged.
real iterate(function(real) -> real f, real x, integer n) = select x, if n == 0; iterate(f, f(x), n - 1) otherwise end;
real a() = iterate(function(real x) -> x / 2 + 1, 10, integer(3 * $position.z));      // expect: 3
const b = iterate(function(real x) -> x / 2 + 1, 10, 3);                              // expect: 3
