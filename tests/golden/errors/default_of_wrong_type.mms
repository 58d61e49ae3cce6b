// A default has the formal's type: said where it stands, and where it is used.
real f(real x, real y = true) = x + y;
//                      ^^^^ error E0203: expected `real`, found `logic`
const a = f(1);
//        ^^^^ error E0203: expected `real`, found `logic`
