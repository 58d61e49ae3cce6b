// `/` on integers gives a real.
const a = 1 / 2;                 // expect: 0.5
const b = 7 / 2 * 2;             // expect: 7
const c = -7 / 2;                // expect: -3.5
integer d() = integer(7 / 2);    // expect: 3
