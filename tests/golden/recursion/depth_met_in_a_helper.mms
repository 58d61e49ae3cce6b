// A recursion that is too long to unroll becomes a function, whichever call is the one too deep.
real next(real x) = x + 1;
real twice(real x) = next(next(x));
real count(integer k, real x) = select x, if k == 0; count(k - 1, twice(x)) otherwise end;
real a() = count(400, 0.0);                                 // expect: 800
real b() = count(401, 0.0);                                 // expect: 802
real same(real x) = count(403, x);
real c() = same(0.0);                                       // expect: 806
