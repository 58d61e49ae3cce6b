// Complex numbers are differentiated as pairs of reals.
surface s
    height = abs(exp(complex($uv.x, $uv.y)));
end
// check-gradient: surface s
surface t
    z = complex($position[0], 1.5 + $position[1]);
    height = im(sin(z) * polar(0.5, $uv.x)) + arg(z + 3) + re(asin(conj(z) / 4) ^ 2);
end
// check-gradient: surface t
