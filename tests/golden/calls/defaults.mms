// A formal may have a default; it is evaluated where the function was defined.
const k = 7;
real f(real a, b = 10 * k, c = 1) = a + b + c;
const p = f(0);                        // expect: 71
const q = f(0, 1);                     // expect: 2
const r = f(0, c = 0);                 // expect: 70
