// Numbers: integers, reals, exponents; true and false.
const a = 0;                     // expect: 0
const b = 42;                    // expect: 42
const c = 0.5;                   // expect: 0.5
const d = 1e3;                   // expect: 1000
const e1 = 1.5e-6;               // expect: 1.5e-6
const f = 2E+2;                  // expect: 200
const g = true;                  // expect: true
const h = false;                 // expect: false
const i = 007;                   // expect: 7
