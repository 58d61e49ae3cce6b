// A function is `= value;` or a body with a `return`.
real sq(real x) = x ^ 2;
real poly(real x)
    y = sq(x);
    ;
    z = y + 1;
    return z * z;
const p = sq(3.0);                     // expect: 9
const q = poly(2.0);                   // expect: 25
