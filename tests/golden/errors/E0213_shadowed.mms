// A script's own names may not hide each other.
const k = 3;
real f(real k) = k;
//          ^ error E0213: the outer one is here
real g(real x)
    real h(real x) = x;
//              ^ error E0213
    return h(x);
const z = g(1);
