// In a function that is differentiated, the width is that of the argument where it is called.
const a = gradient(function(x) -> x * x + filter_width(x), 3.0);                 // expect: 6
surface s
    height = gradient(function(x) -> x * x * filter_width(2 * x), 3 * $position.x + 1.0);
end
// expect-output: surface s height at footprint=(0.01,0,0,0) position=(1,0,0) tangent=(1,0,0) = 0.48
