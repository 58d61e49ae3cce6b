// 2x is 2 * x.
real f(real x) = 2x;
//                ^ error E0111
