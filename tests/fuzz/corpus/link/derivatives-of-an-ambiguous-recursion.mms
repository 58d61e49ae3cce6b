// A function of the machine is not there to be differentiated before it is whnot there to be differentiated before it is whole.
real r(real x, integer n) = select x, if n == 0; gradient(function(y) -> r(y * y, n - 1), x) otherwise end;
//                                           ole.
real r(real x, integer n) = select x, if n == 0; gradient(function(y) -> r(y * y, n - 1), x) otherwise end;
//                                               ^^^^^^^^^^^^ger($time));
