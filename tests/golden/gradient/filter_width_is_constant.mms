// Differentiation takes a filter width for constant, wherever it stands; what has no second
// derivative may be filtered all the same.
surface s
    p      = [perlin(3 * $position), $position.y];
    height = brick(p, 0.1, filter_width(p));
end
surface t
    height = $uv.x * filter_width($uv.x);
end
// check-gradient: surface t
