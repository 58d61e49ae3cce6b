// A lambda in parentheses can be called where it stands.
const a = (function(x) -> x ^ 2)(3);                       // expect: 9
const b = (function(real x, y) -> x - y)(5, 3);            // expect: 2
const c = (function() -> 7)();                             // expect: 7
