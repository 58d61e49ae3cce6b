// Every unit, in metres, radians and kelvin.
const a = [1nm, 1um, 1mm, 1cm, 1m, 1km];    // expect: [1e-9, 1e-6, 1e-3, 1e-2, 1, 1e3]
const b = [180deg, 2rad, 300K];             // expect: [3.14159265358979, 2, 300]
const c = 1.5e2mm;                          // expect: 0.15
