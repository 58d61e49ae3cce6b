// Arguments come by position, then by name, in any order.
real f(real a, b, c) = 100 * a + 10 * b + c;
const p = f(1, 2, 3);                  // expect: 123
const q = f(c = 3, a = 1, b = 2);      // expect: 123
const r = f(1, c = 3, b = 2);          // expect: 123
