// Gold leaf hammered by hand: each blow leaves a shallow dent.
param real dents = 4.5 in [1, 20], label = "Dents per metre";

surface hammered_gold
    p      = dents * $object_position + 0.15 * perlin(9 * $object_position);
    dent   = worley(p);
    bsdf   = gold(0.16);
    height = 0.055 * dent * dent / dents + 0.0012 * perlin(40 * $object_position);
end
