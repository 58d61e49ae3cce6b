// if does not begin an expression.
real f(real x) = if x > 0 then 1 else 2;
//               ^^ error E0148
