// A zero that arrives through a call is told where it divides, with the call.
real inverse(real x) = 1 / x;
//                     ^^^^^ warning W0403: `inverse` is called here
const a = inverse(0.0);
const b = inverse(2.0);    // expect: 0.5
