// A name that is read in one function is still unused in another.
real f(real x)
    y = 2 * x;
    return y;
real g(real x)
    y = 3 * x;
//  ^ warning W0401: `y` is never used
    return x;
