// Glazed bricks in rough mortar: the glaze stops at the joints, which lie deeper.
param real courses = 12.0 in [2, 40], label = "Courses";

/// 1 inside the unit square, falling to 0 over `bevel` at its rim.
real cushion(real[2] q, real bevel)
    real edge(real x) = smoothstep(0.0, bevel, min(x, 1 - x) - 0.03);
    return edge(q.x) * edge(q.y);

surface tiles
    p             = courses * [$uv.x, 0.5 * $uv.y];
    q             = brick_position(p);
    brick         = cushion(q, 0.07);
    tint          = brick_tint(p);
    grain         = fbm(14 * $object_position, 4);
    glaze         = mix(rgb(0.045, 0.16, 0.22), rgb(0.12, 0.34, 0.36), tint);
    mortar        = matte(0.42 + 0.1 * grain);
    brick_surface = fresnel_mix(matte(glaze), glossy(colour = 1, gloss = 700.0), ior = 1.6);
    bsdf          = mix(mortar, brick_surface, smoothstep(0.3, 0.8, brick));
    height        = 0.022 * brick + 0.006 * (1 - brick) * grain;
end
