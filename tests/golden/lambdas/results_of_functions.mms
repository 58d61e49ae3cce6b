// Functions as results, in structures and in arrays, where the link decides which.
op typeid function(real) -> real;
pairs typeid struct op first, second; end;
op again(op f) = function(x) -> f(f(x));
const a = again(#sqrt)(16.0);                                  // expect: 2
real both(pairs p, real x) = p.first(p.second(x));
const b = both(pairs(#sqrt, function(x) -> 2 * x), 8);         // expect: 4
real nth(op[2] fs, integer n, real x) = fs[n](x);
const c = nth([function(x) -> x + 1, function(x) -> x * 2], 1, 5);   // expect: 10
op adder(real n) = function(real x) -> x + n;
const d = adder(3)(4);                                         // expect: 7
