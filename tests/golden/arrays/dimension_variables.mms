// In one and two dimensions; `generic n` even where a constant has the name.
const n = 3;
real exactly(real[n] v) = n;
real any(real[generic m] v) = m;
real product(real[r, k] x, real[k, c] y) = 100 * r + 10 * k + c;
T[c, r] flip(generic T[r, c] x) = [x[0, 0], x[1, 0]; x[0, 1], x[1, 1]];
const a = exactly([1, 2, 3]);                                   // expect: 3
const b = any([1, 2]);                                          // expect: 2
const d = product([1, 2; 3, 4; 5, 6], [1, 2, 3, 4; 5, 6, 7, 8]);   // expect: 324
const q = flip([1, 2; 3, 4]);                                   // expect: [1, 3, 2, 4]
