// A recursion that is no loop, ended by the hit.
real series(real x, integer n) = select 1, if n == 0; 1 + x * series(x / 2, n - 1) otherwise end;
surface s
    height = series($uv.x, 2 + integer(2 * abs($time)));
end
// check-gradient: surface s
