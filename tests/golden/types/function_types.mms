// A function type in parentheses, of functions, and without formals.
real twice((function(real) -> real) f, real x) = f(f(x));
real call(function() -> real f) = f();
real pair(function(real, real) -> real f) = f(2, 3);
const a = twice(function(x) -> x + 1, 1);    // expect: 3
const b = call(function() -> 4);             // expect: 4
const c = pair(#*);                          // expect: 6
