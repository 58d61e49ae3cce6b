// Which function is meant is known at link time.
real f(real x)
    g = select #sin, if x > 0; #cos otherwise end;
//      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0309
    return g(x);
real a() = f($time);
