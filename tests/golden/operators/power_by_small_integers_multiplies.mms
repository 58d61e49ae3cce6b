// x ^ n for a known integer n multiplies out; negative bases are fine.
const a = (-2.0) ^ 3;            // expect: -8
const b = 3 ^ 4;                 // expect: 81
const c = 2.0 ^ 0;               // expect: 1
const d = 2 ^ -2;                // expect: 0.25
const e1 = 2.0 ^ 0.5;            // expect: 1.4142135623730951
real f() = ($position.z - 3) ^ 2;     // expect: 4
real g() = ($position.z - 3) ^ 3;     // expect: -8
real h() = 2 ^ integer(3 * $position.z);   // expect: 8
const i = 4 ^ 0.5;               // expect: 2
const j = 1.0001 ^ 20;           // expect: 1.0020019011404846
