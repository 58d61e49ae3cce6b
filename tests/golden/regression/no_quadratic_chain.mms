// Comparisons chain, and each operand is computed once.
logic f(real x) = 0 < x < 1 < 2 <= 2 < 3;
const a = f(0.5);    // expect: true
const b = f(1.5);    // expect: false
