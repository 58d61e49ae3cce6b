// A hollow ball of pierced porcelain: where `scattering` is 0 the surface is not there at all, so
// light and sight pass without a new path vertex.
param real holes = 16.0 in [4, 60], label = "Holes around";

surface lace
    p          = holes * [$uv.x, 0.5 * $uv.y];
    q          = brick_position(p) - 0.5;
    hole       = length(q);
    rim        = smoothstep(0.30, 0.40, hole);
    scattering = step(0.30, hole);
    bsdf       = fresnel_mix(matte(rgb(0.83, 0.80, 0.74)), glossy(colour = 1, gloss = 400.0),
        ior = 1.5);
    height = 0.02 * rim;
end
