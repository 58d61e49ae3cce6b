// `gradient` is an output's name and, where it is called, the library's function.
surface s
    gradient = gradient(function(q) -> q.x * 3 + q.y * 4, $uv);
    height   = 0.5 * gradient(function(x) -> x * x, 4.0);
    bsdf     = matte(0.5);
end
// expect-output: surface s gradient = [3, 4]
// expect-output: surface s height = 4
