// Something like skin by the library's OpenPBR surface: light enters, wanders and leaves; red goes
// the furthest. The volume of the same name is what lies inside.
param spectrum colour = rgb(0.85, 0.55, 0.42), label = "Colour";
param real radius = 0.12 in [0.001, 10], unit = "m", label = "Depth";

surface skin
    p      = 9 * $object_position;
    bsdf   = openpbr(subsurface_weight = 1.0, specular_roughness = 0.4, specular_ior = 1.4);
    height = 0.004 * fbm(p, 4) - 0.002 * worley_f1(2 * p);
end

volume skin
    inside = openpbr_inside(
        subsurface_weight = 1.0,
        subsurface_color = colour,
        subsurface_radius = radius,
        subsurface_radius_scale = rgb(1.0, 0.75, 0.6)
    );
    scattering = inside.scattering;
    absorption = inside.absorption;
    phase      = henyey_greenstein(inside.anisotropy);
end
