// Nested functions of one name are overloads too.
real f(real x)
    real g(real p) = p;
    real g(real p, q) = p + 2 * q;
    return g(x) + g(x, 10);
const a = f(1);                        // expect: 22
