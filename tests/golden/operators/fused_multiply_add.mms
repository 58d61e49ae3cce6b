// a * b + c is one operation, rounded once; parentheses do not undo it, a name does.
// (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24; as a float product it is 1 + 2^-11.
const s = 1.000244140625;
real fused() = s * s - 1.00048828125;                  // expect: 5.960464477539063e-08
real parenthesised() = (s * s) - 1.00048828125;        // expect: 5.960464477539063e-08
real named()
    p = s * s;
    return p - 1.00048828125;                          // expect: 0
real reversed() = -1.00048828125 + s * s;              // expect: 5.960464477539063e-08
real subtracted() = 1.00048828125 - s * s;             // expect: -5.960464477539063e-08
real varying() = (s * $position.z) * s - 1.00048828125 * $position.z;   // expect~1: 5.960464477539063e-08
real dynamic()
    x = s * $position.z;
    return x * x - 1.00048828125;                      // expect: 5.960464477539063e-08
// Of two products the left one is fused with the rounded right one.
real left() = s * s - s * s;                           // expect: 5.960464477539063e-08
real array() = ([s, s] * s - 1.00048828125).y;         // expect: 5.960464477539063e-08
spectrum spectral() = spectrum(s) * s - 1.00048828125; // expect: 5.960464477539063e-08
integer whole() = 3 * 4 + 5;                           // expect: 17
