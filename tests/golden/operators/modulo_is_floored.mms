// `%` is floored: the result has the sign of the divisor.
const a = 7 % 3;                 // expect: 1
const b = -7 % 3;                // expect: 2
const c = 7 % -3;                // expect: -2
const d = -7 % -3;               // expect: -1
const e1 = -0.25 % 1.0;          // expect: 0.75
const f = 5.5 % -2;              // expect: -0.5
integer n() = integer(5 * $uv.x) % 3;   // expect: 0
real r() = ($position.z - 3.5) % 2;     // expect: 1.5
