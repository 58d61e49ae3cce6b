// A select is an expression like any other.
real f(real x) = 10 * (select select 1, if x > 2; 2 otherwise end, if x > 1; 3 otherwise end) + 1;
const a = f(3);                        // expect: 11
const b = f(1.5);                      // expect: 21
const c = f(0);                        // expect: 31
real d() = f(1.5 * $position.z);       // expect: 21
