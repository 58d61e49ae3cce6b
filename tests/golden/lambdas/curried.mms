// A lambda may return a lambda.
const add_to = 1;
real g(real x) = (function(p) -> (function(q) -> p - q))(x)(2);
const a = g(5);                        // expect: 3
