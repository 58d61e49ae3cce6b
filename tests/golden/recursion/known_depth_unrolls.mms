// A recursion whose end is known at link leaves only its result.
integer fac(integer n) = select 1, if n <= 1; n * fac(n - 1) otherwise end;
const a = fac(10);                     // expect: 3628800
real horner(integer n, real x) = select 1, if n == 0; 1 + x * horner(n - 1, x) otherwise end;
real b() = horner(3, 2 * $position.z); // expect: 15
