// A loop with several states, ended by the hit.
real go(real x, y, integer n) = select x * y, if n == 0; go(x + 0.1 * y, y - 0.1 * x, n - 1) otherwise end;
surface s
    height = go($uv.x, $uv.y, 3 + integer(2 * abs($time)));
end
// check-gradient: surface s
