// A lambda's formals have names, a function type's have none.
const a = (function(real x, y) -> x - y)(y = 1, x = 5);      // expect: 4
const f = function(x, y) -> x / y;
const b = f(y = 2, x = 1);                                    // expect: 0.5
