// Which function is meant may be chosen by what is known at link time.
param logic smooth = true;
real f(real x)
    shape = select #sqrt, if smooth; #abs otherwise end;
    return shape(x);
const a = f(16.0);                     // expect: 4
