// Cooling lava: a dark crust, split where the rock below still glows as a black body.
param real temperature = 1450.0 in [900, 3000], unit = "K", label = "Temperature";

surface lava
    p        = 2.1 * $object_position;
    crack    = abs(fbm(p + 0.45 * [perlin(2 * p), perlin(2 * p + 7.0), perlin(2 * p - 7.0)], 5));
    heat     = 1 - smoothstep(0.0, 0.17, crack);
    // A camera exposed for a lamp-lit room sees a body at 1500 K dimly: open it up.
    emission = 40 * heat * blackbody(900 + (temperature - 900) * heat);
    bsdf     = matte(0.035 + 0.03 * perlin(6 * p));
    height   = 0.06 * smoothstep(0.0, 0.3, crack) + 0.02 * fbm(4 * p, 4);
end
