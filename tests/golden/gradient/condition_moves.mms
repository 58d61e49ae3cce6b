// A recursion that is ended by what moves.
real go(real x, t) = select t, if x > 4; go(1.5 * x + 0.25, t + x * x) otherwise end;
surface s
    height = go(0.5 + abs($uv.x), $uv.y);
end
// check-gradient: surface s
