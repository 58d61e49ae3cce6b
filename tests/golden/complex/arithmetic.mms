// Complex numbers: imaginary literals, four operations, re and im.
const a = (1 + 2i) * (3 - 1i);         // expect: [5, 5]
const b = (1 + 2i) + 1;                // expect: [2, 2]
const c = 1 - 2i;                      // expect: [1, -2]
const d = (5 + 5i) / (1 + 2i);         // expect: [3, -1]
const e1 = -(1 + 2i);                  // expect: [-1, -2]
const f = 1 / 1i;                      // expect: [0, -1]
const g = (1i) ^ 2;                    // expect: [-1, 0]
const h = 2.5i;                        // expect: [0, 2.5]
real i() = re((1 + 2i) * $position.z) + im(3i);    // expect: 4
