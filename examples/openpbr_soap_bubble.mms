// A soap bubble by the library's OpenPBR surface: nothing but a thin film, which gets thinner upwards
// and flows. It keeps all light; its colours are those of interference.
param real thickness = 0.45 in [0, 2], unit = "um", label = "Thickness";

surface soap_bubble
    p    = 2 * $object_position;
    flow = fbm(p + 0.8 * perlin_vector(p), 4);
    bsdf = openpbr(
        transmission_weight = 1.0,
        specular_roughness = 0.0,
        specular_ior = 1.0,
        thin_film_weight = 1.0,
        thin_film_ior = 1.33,
        thin_film_thickness = thickness * (1.0 - 0.35 * $object_position.z + 0.25 * flow)
    );
end
