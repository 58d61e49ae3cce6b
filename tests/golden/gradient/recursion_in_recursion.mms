// A machine function that calls another, both differentiated.
real inner(real x, integer n) = select x, if n == 0; inner(x - 0.1 * sin(x), n - 1) otherwise end;
real outer(real x, integer n) = select x ^ 2, if n == 0; outer(0.5 * inner(x, n) + 0.1, n - 1) otherwise end;
surface s
    height = outer($uv.x + $uv.y, 2 + integer(2 * abs($time)));
end
// check-gradient: surface s
