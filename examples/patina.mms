// Old copper: bare metal on the crests, verdigris where rain collects.
param real age = 0.5 in [0, 1], label = "Age";

surface patina
    p      = $object_position;
    pits   = fbm(3 * p, 6, gain = 0.55);
    cover  = smoothstep(0.12, -0.12, pits - 0.9 * (age - 0.5) + 0.12 * p.y);
    green  = mix(rgb(0.06, 0.24, 0.19), rgb(0.28, 0.55, 0.42), saturate(0.5 + fbm(9 * p, 4)));
    bsdf   = mix(copper(0.3 + 0.15 * saturate(pits)), matte(green), cover);
    height = 0.012 * cover + 0.004 * fbm(24 * p, 3) * cover;
end
