// A formal may leave its size open, or name it; the argument brings it.
real last(real[] v) = v[0];
real count(real[n] v) = n;
real both(real[n] p, q) = n;
real forced(real[generic n] v) = n;
const a = last([7, 8]);                // expect: 7
const b = count([1, 2, 3, 4]);         // expect: 4
const c = both([1, 2], [3, 4]);        // expect: 2
const d = forced([1, 2, 3]);           // expect: 3
