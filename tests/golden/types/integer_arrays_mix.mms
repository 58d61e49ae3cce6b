// Integer arrays widen where reals are wanted.
const a = mix([1, 2], [3, 4], 0.5);               // expect: [2, 3]
const b = mix([1, 2; 3, 4], [3, 4; 5, 6], 0.5);   // expect: [2, 3, 4, 5]
const c = [1, 2] + [3, 4] * 2;                    // expect: [7, 10]
const d = [7, 8] % 3;                             // expect: [1, 2]
const k = [1, 2] / 2;                             // expect: [0.5, 1]
const m = [2, 3] ^ 2;                             // expect: [4, 9]
const n = -[1, 2];                                // expect: [-1, -2]
