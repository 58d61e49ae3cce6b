// Comparisons chain: each neighbouring pair must hold.
const a = 0 < 0.5 < 1;           // expect: true
const b = 0 < 2 < 1;             // expect: false
const c = 3 > 2 >= 2 > 1;        // expect: true
const d = 1 == 1.0 == 1;         // expect: true
const e1 = 1 < 2 > 1 < 3;        // expect: true
const f = 1 != 2 != 1;           // expect: true
logic inside() = 0 <= $uv.x <= 1;   // expect: true
