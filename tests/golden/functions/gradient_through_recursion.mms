// Recursion of the machine is differentiated as it stands, and so is one that is unrolled.
real powers(real x, integer n) = select x, if n == 0; powers(x * x, n - 1) otherwise end;
real climb(real x) = select x, if x > 100; climb(x * x) otherwise end;
const a = gradient(function(x) -> powers(x, 3), 2.0);        // expect: 1024
const b = gradient(#climb, 2.0);                             // expect: 1024
