// Velvet by the library's OpenPBR surface: fibres that stand up and catch light at the rim.
param spectrum colour = rgb(0.06, 0.01, 0.1), label = "Colour";

surface velvet
    p    = 40 * $object_position;
    bsdf = openpbr(
        base_color = colour,
        base_diffuse_roughness = 1.0,
        specular_weight = 0.2,
        specular_roughness = 0.8,
        fuzz_weight = 1.0,
        fuzz_color = mix(colour, rgb(0.9, 0.7, 1.0), 0.8),
        fuzz_roughness = 0.4 + 0.15 * perlin(p)
    );
    height = 0.001 * fbm(p, 3);
end
