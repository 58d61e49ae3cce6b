// Suffixes turn lengths and wavelengths into metres, angles into radians.
const a = 550nm;                 // expect: 5.5e-7
const b = 2.5um;                 // expect: 2.5e-6
const c = 3mm;                   // expect: 0.003
const d = 2cm;                   // expect: 0.02
const e1 = 4m;                   // expect: 4
const f = 1.5km;                 // expect: 1500
const g = 180deg;                // expect: 3.141592653589793
const h = 1rad;                  // expect: 1
const i = 2856K;                 // expect: 2856
const j = 1e1mm;                 // expect: 0.01
const k = 3m / 2;                // expect: 1.5
