// Noise that is said in the language, and cellular noise, are differentiated exactly.
surface s
    height = 0.1 * gabor(2 * $object_position, [1, 2, 0], 3) + 0.1 * gabor_isotropic($uv, 1.5)
        + 0.2 * worley_gap(2 * $object_position, 4, 3.0, 0.8) + 0.1 * worley_edge(3 * $uv)
        + 0.1 * simplex(3 * $object_position, 2) + 0.1 * perlin_vector($uv, 3)[1];
end
// check-gradient: surface s
