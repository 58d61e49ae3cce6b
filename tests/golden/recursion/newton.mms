// A loop that ends by its own result.
real root(real x, guess) = select guess, if abs(guess * guess - x) < 1e-4; root(x, (guess + x / guess) / 2) otherwise end;
real a() = root(2 + 0 * $time, 1);      // expect~1e-4: 1.4142135
real b() = root(2 + $position.x ^ 2, 1);   // expect~1e-4: 1.4142135
// near: 1e-3
