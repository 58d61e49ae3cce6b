// Oak, cut from a solid block: wavy growth rings, fine fibres along the trunk, a satin varnish.
param real rings_per_metre = 7.0 in [1, 40], label = "Rings";

surface wood
    p      = [$object_position.x + 0.35, $object_position.z - 0.9, 0.35 * $object_position.y];
    wobble = 0.09 * fbm(1.3 * p, 4);
    radius = rings_per_metre * (hypot(p.x, p.y) + wobble);
    ring   = fract(radius);
    late   = smoothstep(0.35, 0.92, ring) * (1 - smoothstep(0.95, 1.0, ring));
    fibre  = 0.5 + 0.5 * fbm([60 * p.x, 60 * p.y, 3 * p.z], 3);
    shade  = saturate(0.25 * hash(floor(radius)) + 0.6 * late + 0.25 * (fibre - 0.5));
    colour = mix(rgb(0.56, 0.32, 0.145), rgb(0.19, 0.075, 0.028), shade);
    bsdf   = fresnel_mix(matte(colour), glossy(colour = 1, gloss = 60.0), ior = 1.45);
    height = 0.0015 * fibre - 0.004 * late;
end
