// A machine function with several results, one of them an integer.
pair typeid struct real a; integer n; real b; end;
pair go(pair p, integer n) = select p, if n == 0; go(pair(p.a * p.b, p.n + 1, p.b + 0.1 * p.a), n - 1) otherwise end;
surface s
    q = go(pair($uv.x, 0, $uv.y), 1 + integer(2 * abs($time)));
    height = q.a + q.n * q.b;
end
// check-gradient: surface s
