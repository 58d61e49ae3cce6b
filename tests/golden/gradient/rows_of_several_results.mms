// Rows with several results, rows that are gradients themselves, and formulas in the language.
// near: 1e-3
surface s
    d = worley_pair(2 * $object_position);
    height = 0.1 * (d[1] - d[0]);
end
// check-gradient: surface s
surface t
    g = perlin_gradient(2 * $object_position);
    height = 0.1 * length(g) + 0.1 * perlin_gradient([$uv.x, $uv.y])[1];
end
// check-gradient: surface t
surface u
    height = fresnel($uv.x, 1.2 + 0.3 * sin($uv.y)) + fresnel_conductor($uv.y, 0.2, 3 + $uv.x)
        + sellmeier(550nm, 1.0, 0.006 + 0.001 * $uv.x, 0.2, 0.02, 1.0, 103.0);
end
// check-gradient: surface u
