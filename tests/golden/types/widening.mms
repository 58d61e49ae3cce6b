// integer widens to real to complex, real to spectrum; nothing else widens.
real a() = 3;                    // expect: 3
complex b() = 3;                 // expect: [3, 0]
complex c() = 2.5;               // expect: [2.5, 0]
spectrum d() = 0.25;             // expect: 0.25
spectrum e1() = 2;               // expect: 2
real[3] f() = [1, 2, 3];         // expect: [1, 2, 3]
const g = 1 + 0.5;               // expect: 1.5
const h = 1 + 2i;                // expect: [1, 2]
const real i = 7;                // expect: 7
spectrum[2] j() = [1, 0.5];      // expect: [1, 0.5]
