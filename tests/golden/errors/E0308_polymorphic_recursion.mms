// A recursion that asks for another function at every call has no end.
real grow(function(real) -> real f, integer n) = select f(0), if n == 0; grow(function(x) -> f(x) + 1, n - 1) otherwise end;
//                                                                       ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0308
real a() = grow(#sqrt, integer($position.z));
