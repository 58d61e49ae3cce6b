// `T[c][r]` is `T[r, c]`.
real first(real[2][3] x) = x[2, 1];
const a = first([1, 2; 3, 4; 5, 6]);                      // expect: 6
const b = [1, 2, 3; 4, 5, 6][1][2] + [1, 2, 3; 4, 5, 6][0, 1];   // expect: 8
