// A generic function's names are looked up where it is defined.
generic T f(generic T x) = x + nope;
//                             ^^^^ error E0201
real g(real[n] v) = v[0] + nofunction(v);
//                         ^^^^^^^^^^ error E0202
real h(real[] v)
    nested = function(x) -> x + w;
//                              ^ error E0201
    return nested(v[0]);
