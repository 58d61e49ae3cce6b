// Noise is differentiated exactly.
surface s
    height = 0.1 * perlin(3 * $object_position) + 0.2 * perlin([$uv.x, $uv.y]);
end
// check-gradient: surface s
