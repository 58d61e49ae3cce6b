// A fire without a wick: soot that glows as a black body, hottest inside, torn by turbulence that
// rises. It lights what is around it; its own surface does nothing.
param real temperature = 2000.0 in [1200, 4000], unit = "K", label = "Temperature";
param real brightness = 0.5 in [0, 100], label = "Brightness";

surface fire
    scattering = 0;
end

volume fire
    p     = $object_position;
    h     = saturate(0.5 * p.y + 0.5);
    q     = [2.2 * p.x, 1.1 * p.y, 2.2 * p.z];
    swirl = 0.6 * h * [fbm(q + 3.1, 3), 0.0, fbm(q - 5.7, 3)];
    r     = length([p.x, 0.0, p.z] + swirl);
    // Round below, and running out into tongues above.
    wide  = 1.1 * sqrt(h) * (1 - h);
    body  = saturate(1.6 * (1 - r / (wide + 0.01)) + 0.8 * fbm(1.7 * q, 3) * h);

    emission   = brightness * body * blackbody(temperature * (0.7 + 0.3 * body));
    absorption = 0.8 * body;
end
