// Arrays and structures on the way are taken apart.
pair typeid struct real a; real[2] b; end;
surface s
    q = pair($uv.x ^ 2, [$uv.y, 3 * $uv.x]);
    m = [q.a, q.b.x; q.b.y, 1];
    height = m[0, 0] * m[1, 0] + dot(m[0], q.b);
end
// check-gradient: surface s
