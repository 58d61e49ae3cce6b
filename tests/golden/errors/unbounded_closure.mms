// A function that is wrapped once more at every call has no end.
real deeper(function(real) -> real f, real x) = select f(x), if x > 100; deeper(function(y) -> f(y) + 1, x + 1) otherwise end;
//                                                                       ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0308
real a() = deeper(#sqrt, $time);
