// A dimension that is the name of a const is that size.
const n = 3;
real f(real[n] v) = v[n - 1];
real[n] g() = [1, 2, 3];               // expect: [1, 2, 3]
const a = f([7, 8, 9]);                // expect: 9
real h(real[generic n] v) = 1;
