// A formal without a type has that of its neighbour.
real f(real a, b, integer n, m) = a + b + n % m;
const p = f(0.5, 0.25, 7, 4);          // expect: 3.75
