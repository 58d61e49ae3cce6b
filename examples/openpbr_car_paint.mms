// Car paint by the library's OpenPBR surface: flakes of metal in a coloured base, under a clear coat.
param spectrum colour = rgb(0.45, 0.02, 0.03), label = "Colour";
param real flakes = 0.5 in [0, 1], label = "Flakes";

surface car_paint
    flake = cellnoise(90 * $object_position);
    bsdf  = openpbr(
        base_color = mix(colour, rgb(0.9, 0.5, 0.4), 0.25 * flakes * flake),
        base_metalness = 0.3 + 0.7 * flakes * flake,
        specular_roughness = 0.35 + 0.25 * flake,
        coat_weight = 1.0,
        coat_color = rgb(1.0, 0.9, 0.9)
    );
end
