// Powers of complex numbers, and their comparison.
const a = (2 + 0i) ^ (3 + 0i);         // expect: [8, 0]
const b = 1i ^ -1;                     // expect: [0, -1]
const c = (1 + 2i) == (1 + 2i);        // expect: true
const d = (1 + 0i) == 1;               // expect: true
