// Recursion, choices and remainders: one wavelength at a time.
real halve(real x) = select x, if x <= 1; halve(x / 2) otherwise end;
spectrum steps() = spectral(function(l) -> select 1.0, if halve(l * 1e9) > 0.5; 0.0 otherwise end);   // expect: 1
spectrum remainder() = spectral(function(l) -> (2 + 0 * l) % 1.5);                                    // expect: 0.5
