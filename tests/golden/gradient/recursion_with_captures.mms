// What a machine function captures moves too.
surface s
    k = $uv.x ^ 2 + $position.y;
    real go(real x, integer n) = select x * k, if n == 0; go(x + 0.25 * k * x, n - 1) otherwise end;
    height = go($uv.y, 2 + integer(2 * abs($time)));
end
// check-gradient: surface s
