// `T[c][r]` is `T[r, c]`.
real f(real[2][3] m) = m[2, 1];
const a = f([1, 2; 3, 4; 5, 6]);    // expect: 6
