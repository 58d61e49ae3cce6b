// Escape time of a quadratic iteration: a tail-recursive loop over complex numbers.
integer escape(complex z, c, integer n) = select n, if n == 20 or abs(z) > 2; escape(z * z + c, c, n + 1) otherwise end;
integer a() = escape(complex($position.x, $position.z), -1 + 0i, 0);     // expect: 2
const b = escape(0i, 1 + 0i, 0);       // expect: 3
