// A constant may read the hit; in a machine function it is read again.
const k = $position.z;
real f(integer n, real t) = select t + k, if n == 0; f(n - 1, t * 2 * k) otherwise end;
real a() = f(integer(3 * $position.z), 1);                                   // expect: 9
