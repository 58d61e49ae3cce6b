// Every other conversion is written; a real goes to an integer towards zero.
const a = integer(3.7);          // expect: 3
const b = integer(-3.7);         // expect: -3
const c = real(3);               // expect: 3
const d = integer(true);         // expect: 1
const e1 = real(false);          // expect: 0
const f = integer(1e20);         // expect: 2147483647
const g = integer(-1e20);        // expect: -2147483648
integer h() = integer(0.0 / $time);     // expect: 0
const i = complex(1, 2);         // expect: [1, 2]
const j = complex(4);            // expect: [4, 0]
const k = spectrum(0.5);         // expect: 0.5
const l = logic(true);           // expect: true
integer m() = integer($position.z * 2.9);   // expect: 2
real n() = real($position.z > 0);           // expect: 1
const o = integer(5);            // expect: 5
