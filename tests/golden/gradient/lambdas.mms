// Functions handed over are differentiated through.
real apply(function(real) -> real f, real x) = f(f(x));
surface s
    height = apply(function(x) -> sin(3 * x) + $uv.y, $uv.x);
end
// check-gradient: surface s
