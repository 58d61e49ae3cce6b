// A default may use the formals before it.
real f(real x, y = 2 * x, z = x + y) = 100 * x + 10 * y + z;
const a = f(1);                  // expect: 123
const b = f(1, z = 5);           // expect: 125
const c = f(1, 4);               // expect: 145
const d = f(y = 1, x = 3);       // expect: 314
