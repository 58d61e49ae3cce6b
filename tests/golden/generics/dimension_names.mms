// A dimension is deduced, forced to be new, and used as a number.
real last(real[generic n] v) = v[n - 1];
real count(real[k, m] v) = 10 * k + m;
const a = last([1, 2, 3, 4]);          // expect: 4
const b = count([1, 2, 3; 4, 5, 6]);    // expect: 23
