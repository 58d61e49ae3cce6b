// A machine function takes what it captures as further arguments.
real f(real x)
    k = 2 * x;
    real g(integer n, real t) = select t + k, if n == 0; g(n - 1, t + x) otherwise end;
    return g(integer(5 * $position.z), 0);
real a() = f($position.z);                          // expect: 7
