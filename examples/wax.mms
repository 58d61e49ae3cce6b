// Candle wax: a rough skin, and under it a body in which light wanders. The volume fills the
// closed surface of its name.
param real density = 14.0 in [1, 200], unit = "1/m", label = "Density";

surface wax
    bsdf   = dielectric(ior = 1.42, roughness = 0.42);
    height = 0.006 * fbm(3.5 * $object_position, 3);
end

volume wax
    scattering = density * rgb(0.97, 0.86, 0.62);
    absorption = 0.03 * density * rgb(0.05, 0.25, 0.8);
    phase      = henyey_greenstein(0.5);
end
