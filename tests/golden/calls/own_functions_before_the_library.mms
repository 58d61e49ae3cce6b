// A script may reuse a name of the library; where its own do not fit, the library's are tried.
real sin(integer n) = 10 * n;
const a = sin(2);                      // expect: 20
const b = sin(0.0);                    // expect: 0
