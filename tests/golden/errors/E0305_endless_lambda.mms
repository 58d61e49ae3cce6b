// A lambda that calls itself through a constant has no end at link.
const f = function(x) -> f(x);
//                       ^^^^ error E0305
const a = f(1);
