// A generic that a function's result and an argument share widens to hold both.
U pick(function(generic T) -> U f, generic U otherwise_, T x, logic c) = select f(x), if c; otherwise_ otherwise end;
const a = pick(function(x) -> x / 2, 1, 4, true);         // expect: 2
const b = pick(function(x) -> x + 1i, 1, 4, false);       // expect: [1, 0]
