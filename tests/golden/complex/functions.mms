// The library's functions of complex numbers.
const a = abs(3 + 4i);                       // expect: 5
const b = conj(1 + 2i);                      // expect: [1, -2]
const c = arg(1i);                           // expect: 1.5707963267948966
const d = exp(0i);                           // expect: [1, 0]
const e1 = sqrt(complex(-4));                // expect: [0, 2]
const a1 = abs(complex(3e38, 1e30));         // expect: 3.0000000054977558e38
const a2 = map(#abs, [3 - 4i, -2]);          // expect: [5, 2]
const f = polar(2, 0);                       // expect: [2, 0]
const f1 = polar(2, 90deg).im;               // expect: 2
const g = (1 + 1i)^4;                        // expect: [-4, 0]
complex h() = log(complex($position.z, 0));  // expect: [0, 0]
