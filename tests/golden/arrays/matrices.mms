// Rows are separated by `;`; m[i, j] is m[i][j]; m[i] is a row.
const m = [1, 2, 3; 4, 5, 6];          // expect: [1, 2, 3, 4, 5, 6]
const a = m[1, 2];                     // expect: 6
const b = m[1][0];                     // expect: 4
const c = m[0];                        // expect: [1, 2, 3]
real[2, 3] f() = m * 2;                // expect: [2, 4, 6, 8, 10, 12]
real[3][2] g() = m;                    // expect: [1, 2, 3, 4, 5, 6]
real h(real[r, s] x) = 10 * r + s;
const d = h(m);                        // expect: 23
real i() = $footprint[0, 1];           // expect: 0
