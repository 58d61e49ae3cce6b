// Which function is meant may be chosen by an argument that every call knows.
real shaped(logic smooth, real x)
    f = select #sqrt, if smooth; #abs otherwise end;
    return f(x);
real a() = shaped(true, 16 * $position.z);     // expect: 4
real b() = shaped(false, -16 * $position.z);   // expect: 16
