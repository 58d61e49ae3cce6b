// What a lambda captures is constant to it.
real f(real s)
    w = s * 3;
    return gradient(function(x) -> w * x + s, 5.0);
const a = f(2);                                              // expect: 6
real at_hit() = gradient(function(x) -> $time * x, 5.0) - $time;   // expect: 0
