// SPDX-License-Identifier: Apache-2.0
// Metals, glasses and liquids by name.

/// Real part of the refractive index of silver at a wavelength in metres, or at each of a spectrum
/// (handbook data, 299 to 886 nm, linear between rows, ends held).
/// >>> silver_n(550nm)
/// 0.124...
T silver_n(generic T wavelength) = optical_table(wavelength, 20);

/// Imaginary part of the refractive index (extinction) of silver; as `silver_n`.
/// >>> silver_k(550nm)
/// 3.339...
T silver_k(generic T wavelength) = optical_table(wavelength, 21);

/// Real part of the refractive index of gold at a wavelength in metres, or at each of a spectrum
/// (handbook data, 299 to 886 nm, linear between rows, ends held).
/// >>> gold_n(550nm)
/// 0.350...
T gold_n(generic T wavelength) = optical_table(wavelength, 22);

/// Imaginary part of the refractive index (extinction) of gold; as `gold_n`.
/// >>> gold_k(550nm)
/// 2.714...
T gold_k(generic T wavelength) = optical_table(wavelength, 23);

/// Real part of the refractive index of copper at a wavelength in metres, or at each of a spectrum
/// (handbook data, 299 to 886 nm, linear between rows, ends held).
/// >>> copper_n(550nm)
/// 0.958...
T copper_n(generic T wavelength) = optical_table(wavelength, 24);

/// Imaginary part of the refractive index (extinction) of copper; as `copper_n`.
/// >>> copper_k(550nm)
/// 2.577...
T copper_k(generic T wavelength) = optical_table(wavelength, 25);

/// Real part of the refractive index of aluminium at a wavelength in metres, or at each of a spectrum
/// (handbook data, 299 to 886 nm, linear between rows, ends held).
/// >>> aluminium_n(550nm)
/// 0.958...
T aluminium_n(generic T wavelength) = optical_table(wavelength, 26);

/// Imaginary part of the refractive index (extinction) of aluminium; as `aluminium_n`.
/// >>> aluminium_k(550nm)
/// 6.686...
T aluminium_k(generic T wavelength) = optical_table(wavelength, 27);

/// Real part of the refractive index of brass at a wavelength in metres, or at each of a spectrum
/// (handbook data, 290 to 890 nm, linear between rows, ends held).
/// >>> brass_n(550nm)
/// 0.527...
T brass_n(generic T wavelength) = optical_table(wavelength, 28);

/// Imaginary part of the refractive index (extinction) of brass; as `brass_n`.
/// >>> brass_k(550nm)
/// 2.765...
T brass_k(generic T wavelength) = optical_table(wavelength, 29);

/// Real part of the refractive index of magnesium oxide at a wavelength in metres, or at each of a
/// spectrum (handbook data, 310 to 768 nm, linear between rows, ends held).
/// >>> magnesium_oxide_n(550nm)
/// 1.740...
T magnesium_oxide_n(generic T wavelength) = optical_table(wavelength, 30);

/// Imaginary part of the refractive index (extinction) of magnesium oxide; as `magnesium_oxide_n`.
/// >>> magnesium_oxide_k(550nm)
/// 0
T magnesium_oxide_k(generic T wavelength) = optical_table(wavelength, 31);

/// Real part of the refractive index of titanium dioxide (rutile) at a wavelength in metres, or at
/// each of a spectrum (handbook data, 306 to 900 nm, linear between rows, ends held).
/// >>> titanium_dioxide_n(550nm)
/// 2.954...
T titanium_dioxide_n(generic T wavelength) = optical_table(wavelength, 32);

/// Imaginary part of the refractive index (extinction) of titanium dioxide (rutile); as
/// `titanium_dioxide_n`.
/// >>> titanium_dioxide_k(550nm)
/// 0
T titanium_dioxide_k(generic T wavelength) = optical_table(wavelength, 33);

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

/// Polished to rough brass.
/// >>> brass(0.3)
material brass(real roughness = 0.1) =
    conductor(brass_n($wavelength), brass_k($wavelength), roughness);

/// Clear smooth glass; disperses where `ior` varies with wavelength: `glass(bk7())`.
/// >>> glass(bk7())
material glass(spectrum ior = 1.5) = dielectric(ior);

/// Clear water with its own dispersion.
/// >>> water()
material water() = dielectric(water_ior());

/// Refractive index of borosilicate crown glass N-BK7 (Schott catalogue).
/// >>> bk7()
/// 1.5...
spectrum bk7() = bk7($wavelength);

/// `bk7()` at a wavelength in metres: `abbe_number(#bk7)`.
/// >>> bk7(587.5618nm)
/// 1.51680...
T bk7(generic T wavelength) =
    sellmeier(wavelength, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144,
        1.01046945, 103.560653);

/// Refractive index of dense flint glass N-SF11 (Schott catalogue): strong dispersion.
/// >>> sf11()
/// 1.8...
spectrum sf11() = sf11($wavelength);

/// `sf11()` at a wavelength in metres: `abbe_number(#sf11)`.
/// >>> sf11(587.5618nm)
/// 1.78471...
T sf11(generic T wavelength) =
    sellmeier(wavelength, 1.73759695, 0.013188707, 0.313747346, 0.0623068142,
        1.89878101, 155.23629);

/// Refractive index of dense flint glass N-SF5 (Schott catalogue).
/// >>> luminance(sf5())
/// 1.6...
spectrum sf5() = sf5($wavelength);

/// `sf5()` at a wavelength in metres: `abbe_number(#sf5)`.
/// >>> sf5(587.5618nm)
/// 1.67270...
T sf5(generic T wavelength) =
    sellmeier(wavelength, 1.52481889, 0.011254756, 0.187085527, 0.0588995392,
        1.42729015, 129.141675);

/// Refractive index of dense flint glass N-SF10 (Schott catalogue).
/// >>> luminance(sf10())
/// 1.7...
spectrum sf10() = sf10($wavelength);

/// `sf10()` at a wavelength in metres: `abbe_number(#sf10)`.
/// >>> sf10(587.5618nm)
/// 1.72827...
T sf10(generic T wavelength) =
    sellmeier(wavelength, 1.62153902, 0.0122241457, 0.256287842, 0.0595736775,
        1.64447552, 147.468793);

/// Refractive index of barium flint glass N-BAF10 (Schott catalogue).
/// >>> baf10()
/// 1.6...
spectrum baf10() = baf10($wavelength);

/// `baf10()` at a wavelength in metres: `abbe_number(#baf10)`.
/// >>> baf10(587.5618nm)
/// 1.67002...
T baf10(generic T wavelength) =
    sellmeier(wavelength, 1.5851495, 0.00926681282, 0.143559385, 0.0424489805,
        1.08521269, 105.613573);

/// Refractive index of fluor crown glass N-FK51A (Schott catalogue): hardly any dispersion.
/// >>> fk51a()
/// 1.4...
spectrum fk51a() = fk51a($wavelength);

/// `fk51a()` at a wavelength in metres: `abbe_number(#fk51a)`.
/// >>> fk51a(587.5618nm)
/// 1.48656...
T fk51a(generic T wavelength) =
    sellmeier(wavelength, 0.971247817, 0.00472301995, 0.216901417, 0.0153575612,
        0.904651666, 168.68133);

/// Refractive index of lanthanum flint glass N-LASF9 (Schott catalogue): high index.
/// >>> luminance(lasf9())
/// 1.8...
spectrum lasf9() = lasf9($wavelength);

/// `lasf9()` at a wavelength in metres: `abbe_number(#lasf9)`.
/// >>> lasf9(587.5618nm)
/// 1.85024...
T lasf9(generic T wavelength) =
    sellmeier(wavelength, 2.00029547, 0.0121426017, 0.298926886, 0.0538736236,
        1.80691843, 156.530829);

/// Refractive index of diamond (Peter 1923).
/// >>> diamond()
/// 2.4...
spectrum diamond() = diamond($wavelength);

/// `diamond()` at a wavelength in metres: `abbe_number(#diamond)`.
/// >>> diamond(587.5618nm)
/// 2.41748...
T diamond(generic T wavelength) = sellmeier(wavelength, 0.3306, 0.030625, 4.3356, 0.011236,
    0.0, 0.0);

/// Refractive index of pure water at 20 degrees Celsius (Quan and Fry 1995).
/// >>> water_ior()
/// 1.3...
spectrum water_ior()
    nm = $wavelength * 1e9;
    return 1.313242 + (15.7834 + (1.1455e6 / nm - 4382.0) / nm) / nm;

/// Metal under a transparent film `thickness` metres thin: its colours are those of interference.
/// >>> coated_metal(2.5, 3.0, 250nm)
material coated_metal(spectrum n, k, real thickness, spectrum film_ior = 1.5,
    real roughness = 0.0) =
    film_conductor(n, k, film_ior, thickness, $wavelength, roughness);

/// Glass under a transparent film `thickness` metres thin, such as a lens' coating.
/// >>> coated_glass(1.5, 100nm)
material coated_glass(spectrum ior, real thickness, spectrum film_ior = 1.38,
    real roughness = 0.0) =
    film_dielectric(ior, film_ior, thickness, $wavelength, roughness);

/// `base`, such as a matte, under facets `top` and a transparent film `thickness` metres thin on
/// them: oil on plastic, the wing of a beetle.
/// >>> coated_plastic(matte(0.02), microfacet(1, 0.2), 400nm)
material coated_plastic(material base, top, real thickness, spectrum ior = 1.5, film_ior = 1.38) =
    film_mix(base, top, ior, film_ior, thickness, $wavelength);

/// Phase function of two Henyey-Greenstein lobes: `g1` with weight 1 - t, `g2` with weight t.
/// >>> two_lobe(0.8, -0.3, 0.25)
material two_lobe(real g1, g2, spectrum t) = mix(henyey_greenstein(g1), henyey_greenstein(g2), t);
