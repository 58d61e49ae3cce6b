// SPDX-License-Identifier: Apache-2.0
// Metals, glasses and liquids by name.

/// Polished to rough gold.
/// >>> gold(0.2)
material gold(real roughness = 0.1) =
    conductor(gold_n($wavelength), gold_k($wavelength), roughness);

/// Polished to rough silver.
/// >>> silver()
material silver(real roughness = 0.1) =
    conductor(silver_n($wavelength), silver_k($wavelength), roughness);

/// Polished to rough copper.
/// >>> copper(0.2)
material copper(real roughness = 0.1) =
    conductor(copper_n($wavelength), copper_k($wavelength), roughness);

/// Polished to rough aluminium.
/// >>> aluminium()
material aluminium(real roughness = 0.1) =
    conductor(aluminium_n($wavelength), aluminium_k($wavelength), roughness);

/// Clear smooth glass; disperses where `ior` varies with wavelength: `glass(bk7())`.
/// >>> glass(bk7())
material glass(spectrum ior = 1.5) = dielectric(ior);

/// Clear water with its own dispersion.
/// >>> water()
material water() = dielectric(water_ior());

/// Refractive index of borosilicate crown glass N-BK7 (Schott catalogue).
/// >>> bk7()
/// 1.5...
spectrum bk7() = sellmeier($wavelength, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144,
    1.01046945, 103.560653);

/// Refractive index of dense flint glass N-SF11 (Schott catalogue): strong dispersion.
/// >>> sf11()
/// 1.8...
spectrum sf11() = sellmeier($wavelength, 1.73759695, 0.013188707, 0.313747346, 0.0623068142,
    1.89878101, 155.23629);

/// Refractive index of diamond (Peter 1923).
/// >>> diamond()
/// 2.4...
spectrum diamond() = sellmeier($wavelength, 0.3306, 0.030625, 4.3356, 0.011236, 0.0, 0.0);

/// Refractive index of pure water at 20 degrees Celsius (Quan and Fry 1995).
/// >>> water_ior()
/// 1.3...
spectrum water_ior()
    nm = $wavelength * 1e9;
    return 1.313242 + (15.7834 + (1.1455e6 / nm - 4382.0) / nm) / nm;

/// Metal under a transparent film `thickness` metres thin: its colours are those of interference.
/// >>> coated_metal(2.5, 3.0, 250nm)
material coated_metal(spectrum n, k, real thickness, spectrum film_ior = 1.5, real roughness = 0.0) =
    film_conductor(n, k, film_ior, thickness, $wavelength, roughness);

/// Smooth glass under a transparent film `thickness` metres thin, such as a lens' coating.
/// >>> coated_glass(1.5, 100nm)
material coated_glass(spectrum ior, real thickness, spectrum film_ior = 1.38) =
    film_dielectric(ior, film_ior, thickness, $wavelength);

/// Phase function of two Henyey-Greenstein lobes: `g1` with weight 1 - t, `g2` with weight t.
/// >>> two_lobe(0.8, -0.3, 0.25)
material two_lobe(real g1, g2, spectrum t) = mix(henyey_greenstein(g1), henyey_greenstein(g2), t);
