// A lambda sees what is defined around it.
real apply(function(real) -> real f, real x) = f(x);
real g(real k)
    m = 10 * k;
    return apply(function(x) -> x + m + k, 1);
const a = g(2);                        // expect: 23
real b() = g($position.z);             // expect: 12
