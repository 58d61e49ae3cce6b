// Derivatives are values like any other, so they have derivatives.
const second = gradient(function(x) -> gradient(function(y) -> y ^ 3, x), 2.0);     // expect: 12
const mixed = gradient(function(x) -> gradient(function(y) -> y ^ 3 * x, x), 2.0);  // expect: 36
