// Powers bind tightest, then signs, products, sums, comparisons, not, and, or.
const a = 2 + 3 * 4;             // expect: 14
const b = -2 ^ 2;                // expect: -4
const c = 2 ^ 3 ^ 2;             // expect: 512
const d = 2 ^ -1;                // expect: 0.5
const e1 = 2 * -3;               // expect: -6
const f = 7 - 2 - 1;             // expect: 4
const g = 24 / 4 / 2;            // expect: 3
const h = 1 + 2 == 3 and not 2 < 1;   // expect: true
const i = true or false and false;    // expect: true
const j = not true or true;           // expect: true
const k = 2 * 3 % 4;             // expect: 2
const l = not 1 == 2;            // expect: true
const m = (2 + 3) * 4;           // expect: 20
const n = 10 - 3 % 2 * 4;        // expect: 6
