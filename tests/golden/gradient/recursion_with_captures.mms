// What a machine function captures moves too.
// near: 1e-4  (two products of up to 100 nearly cancel where the derivative is about 1: 20 roundings of 6e-8 of them)
surface s
    k = $uv.x ^ 2 + $position.y;
    real go(real x, integer n) = select x * k, if n == 0; go(x + 0.25 * k * x, n - 1) otherwise end;
    height = go($uv.y, 2 + integer(2 * abs($time)));
end
// check-gradient: surface s
