// A function value takes all its arguments.
const a = (function(x, y) -> x + y)(1);
//        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0231
real f(function(real) -> real g) = g(1, 2);
//                                 ^^^^^^^ error E0231
const b = f(#sqrt);
real h(function(real, real, real) -> real g) = g(1, 2, 3);
//                                             ^^^^^^^^^^ error E0231
const c = h(#+);
