// Every basic type by name.
const a = spectrum(2);                       // expect: 2
const b = complex(3);                        // expect: [3, 0]
const c = complex(1, 2) + 2.5i * 2;          // expect: [1, 7]
const d = integer(-3.7);                     // expect: -3
const k = real(true) + integer(true);        // expect: 2
const m = re(complex(1, 2)) + im(1i) + conj(1i).im;   // expect: 1
const n = logic(true);                       // expect: true
