// A param's value may be replaced from outside, and everything follows.
// param: scale=2 * 3
// param: n=7
param real scale = 4.0 in [0.1, 20];
param integer n = 3;
const a = scale + n;                   // expect: 13
real[n] f() = [1, 1, 1, 1, 1, 1, 1];   // expect: [1, 1, 1, 1, 1, 1, 1]
