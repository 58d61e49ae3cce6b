// A nested function sees what is defined above it.
real f(real x)
    k = 3 * x;
    real g(real y)
        real h(real z) = x + k + y + z;
        return h(1000);
    return g(100);
const a = f(1);                        // expect: 1104
real b() = f($position.z);             // expect: 1104
