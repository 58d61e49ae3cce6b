// At the top level a name may be used before its definition.
real f() = g(k);                       // expect: 9
const k = m + 1;
real g(real x) = x * x;
const m = 2;
