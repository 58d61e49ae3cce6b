// A default has the formal's type; it is looked at where it is used.
real f(real x, real y = true) = x + y;
const a = f(1);
//        ^^^^ error E0203: expected `real`, found `logic`
