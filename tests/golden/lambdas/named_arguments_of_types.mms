// The names of a function type's formals are not told.
real f(function(real, real) -> real g) = g(y = 1, x = 2);
//                                       ^^^^^^^^^^^^^^^ error E0204: by position
const a = (function(x) -> x)(z = 2);
//        ^^^^^^^^^^^^^^^^^^^^^^^^^ error E0204: no argument `z`
