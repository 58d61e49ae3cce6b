// `^` binds to the right, tighter than a sign before it, and takes a sign after it.
const a = 2^3^2;      // expect: 512
const b = -2^2;       // expect: -4
const c = 2^-1;       // expect: 0.5
const d = 2^--2;      // expect: 4
const e = (2^3)^2;    // expect: 64
