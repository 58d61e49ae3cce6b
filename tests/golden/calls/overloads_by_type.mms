// The candidate with the fewest widening steps is taken.
real f(integer n) = 1;
real f(real x) = 2;
real f(complex z) = 3;
real f(spectrum s) = 4;
real f(real[2] p) = 5;
real f(real x, y) = 6;
const a = f(1);                        // expect: 1
const b = f(1.0);                      // expect: 2
const c = f(1i);                       // expect: 3
const d = f(spectrum(1));              // expect: 4
const e1 = f([1, 2]);                  // expect: 5
const g = f(1, 2);                     // expect: 6
