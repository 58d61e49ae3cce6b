// Candle wax: a thin glossy skin, and under it a body in which light wanders. The volume fills the
// closed surface of its name; where the skin does not scatter, light passes it undisturbed.
param real density = 12.0 in [1, 200], unit = "1/m", label = "Density";

surface wax
    facing     = abs(dot($normal, $view));
    scattering = fresnel(facing, 1.42);
    bsdf       = glossy(colour = 1, gloss = 120.0);
    height     = 0.006 * fbm(3.5 * $object_position, 3);
end

volume wax
    // Every wavelength is scattered alike; the colour is what the body keeps of it.
    scattering = density;
    absorption = 0.06 * density * rgb(0.01, 0.14, 0.8);
    phase      = henyey_greenstein(0.4);
end
