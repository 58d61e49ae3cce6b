// A param may be the size of an array.
param integer n = 2;
real[n] f() = [1, 2];                  // expect: [1, 2]
