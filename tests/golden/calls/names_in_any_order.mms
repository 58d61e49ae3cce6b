// Arguments by name come in any order, after those by position.
real f(real a, b = 2, c = 3) = 100 * a + 10 * b + c;
const x = f(1);               // expect: 123
const y = f(1, c = 5);        // expect: 125
const z = f(c = 7, a = 4, b = 0);    // expect: 407
