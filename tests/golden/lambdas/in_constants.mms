// A constant may be a function.
const f = function(real x) -> x + 1;
const g = #sqrt;
const a = f(1) + g(16.0) + (#f)(1);    // expect: 8
