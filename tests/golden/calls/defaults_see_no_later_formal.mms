// Only those before it.
real f(real x = z, z = 1) = x + z;
//              ^ error E0201
