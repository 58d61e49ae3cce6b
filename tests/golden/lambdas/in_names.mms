// A name may be a function.
real g(real x)
    f = function(real y) -> y * x;
    h = #sqrt;
    return f(h(16.0));
const a = g(3);                        // expect: 12
