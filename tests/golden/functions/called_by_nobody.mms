// Functions that nobody calls are checked one after the other in the same memory: what one of them
// leaves behind (constants, instances of recursive functions, nested functions, derivatives) the
// next one finds again.
const table = array(8, function(i) -> i * i);
const twice = function(real x) -> 2 * x;
real falls(real x, integer n) = select x, if n < 1; falls(x / 2, n - 1) otherwise end;
real first(real x, integer n) = falls(x, n) + table[n] + twice(x) + pi;
real second(real x, integer n) = falls(x, n + 1) + table[n] + twice(x) + pi;
real third(real x)
    const half = pi / 2;
    real inside(real y) = y * half + table[3];
    f = function(real y) -> inside(y) + twice(y);
    return f(x) + falls(x, integer(x));
real[2] fourth(real[2] p) = gradient(function(real[2] q) -> falls(q[0] * q[1], integer(p[0])), p);
real fifth(real x)
    real inside(real y) = y * twice(x);
    return inside(x) + third(x) + fourth([x, 1])[0];
spectrum sixth(spectrum s) = spectral(function(real w) -> w * first(0.5, 1), s);
real seventh(real x) = wrong(x) + first(x, 1);
//                     ^^^^^ error E0202: unknown function `wrong`
