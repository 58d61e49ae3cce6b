// A function of stated types is taken before a generic one.
real f(generic T v) = 1;
real f(real v) = 2;
const a = f(1.5);                      // expect: 2
const b = f([1.5]);                    // expect: 1
const c = f(1);                        // expect: 2
