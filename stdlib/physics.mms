// SPDX-License-Identifier: Apache-2.0
// Formulas of optics. Lengths and wavelengths are in metres, angles in radians, temperatures in
// kelvin. A function of a wavelength becomes a spectrum by `spectral(function(l) -> ...)`.

/// The angle from the normal at which light goes on that comes at `angle`, in [0, pi/2], from index
/// `from` into index `to` (Snell's law); 90 degrees where all is reflected.
/// >>> snell(30deg, 1.0, 1.5) / 1deg
/// 19.47...
/// >>> snell(80deg, 1.5, 1.0) / 1deg
/// 90
real snell(real angle, from, to) = asin(min(from / to * sin(angle), 1.0));

/// The angle of incidence, from index `from` onto index `to`, at which what is reflected is polarised
/// in full.
/// >>> brewster_angle(1.0, 1.5) / 1deg
/// 56.3...
real brewster_angle(real from, to) = atan2(to, from);

/// The angle of incidence beyond which light from index `from` is reflected in full by index `to`;
/// 90 degrees where there is none, since `to` is the larger.
/// >>> critical_angle(1.5, 1.0) / 1deg
/// 41.8...
real critical_angle(real from, to) = asin(min(to / from, 1.0));

/// The wavelength at which a black body radiates most, for each nanometre (Wien's law).
/// >>> wien_peak(5772K) / 1nm
/// 502.0...
real wien_peak(real temperature) = 2.897771955e-3 / temperature;

/// The temperature of the black body that radiates most at a wavelength.
/// >>> wien_temperature(502nm)
/// 5772...
real wien_temperature(real wavelength) = 2.897771955e-3 / wavelength;

/// Scattering of a gas, per metre: `ior` is its refractive index, `density` its molecules in a cubic
/// metre, `depolarisation` the ratio of its molecules, 0 for round ones (Rayleigh; Penndorf 1957).
/// >>> rayleigh(550nm, 1.000278, 2.547e25, 0.03) / 1e-5
/// 1.1...
real rayleigh(real wavelength, ior, density, depolarisation = 0.0)
    n     = (ior - 1.0) * (ior + 1.0);
    micro = wavelength * 1e6;
    king  = (6.0 + 3.0 * depolarisation) / (6.0 - 7.0 * depolarisation);
    return (8.0 * pi^3 / 3.0) * king * (n * 1e12) * (n * (1e12 / density)) / micro^4;

/// Scattering of air at sea level and 15 degrees Celsius, per metre: what makes the sky blue.
/// >>> air_scattering() * $wavelength ^ 4 / 1e-30
/// 1.06...
spectrum air_scattering() = spectral(function(l) -> rayleigh(l, 1.000278, 2.547e25, 0.03));

/// The phase function of Rayleigh scattering, for each steradian; `cosine` is that of the angle by
/// which light is turned.
/// >>> phase_rayleigh(0.0) * 16 * pi
/// 3
real phase_rayleigh(real cosine) = 3.0 / (16.0 * pi) * (1.0 + cosine * cosine);

/// The phase function of Henyey and Greenstein (1941), for each steradian; g, in (-1, 1), is the mean
/// cosine.
/// >>> phase_henyey_greenstein(1.0, 0.5) * 4 * pi
/// 6
real phase_henyey_greenstein(real cosine, g) = phase_draine(cosine, g, 0.0);

/// The phase function of Draine (2003), for each steradian: `alpha` 0 is Henyey and Greenstein's,
/// `g` 0 and `alpha` 1 is Rayleigh's.
/// >>> phase_draine(0.5, 0.0, 1.0) == phase_rayleigh(0.5)
/// true
real phase_draine(real cosine, g, alpha)
    away = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine);
    tilt = (1.0 + alpha * cosine * cosine) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
    return (1.0 - g) * (1.0 + g) / (4.0 * pi) * tilt / (away * sqrt(away));

/// How fog and cloud of droplets of that diameter, 5 um to 50 um, scatter, as a mixture that is near
/// Mie's theory: [g of `phase_henyey_greenstein`, g of `phase_draine`, its alpha, its weight]
/// (Jendersie and d'Eon 2023).
/// >>> fog_coefficients(20um)[0]
/// 0.994...
real[4] fog_coefficients(real diameter)
    d = clamp(diameter * 1e6, 5.0, 50.0);
    return [
        exp(-0.0990567 / (d - 1.67154)),
        exp(-2.20679 / (d + 3.91029) - 0.428934),
        exp(3.62489 - 8.29288 / (d + 5.52825)),
        exp(-0.599085 / (d - 0.641583) - 0.665888)
    ];

/// The phase function of fog and cloud of droplets of that diameter, for each steradian.
/// >>> phase_fog(1.0, 20um) > 1000 * phase_fog(0.0, 20um)
/// true
real phase_fog(real cosine, diameter)
    c = fog_coefficients(diameter);
    return mix(phase_henyey_greenstein(cosine, c[0]), phase_draine(cosine, c[1], c[2]), c[3]);

/// How much a thin clear film reflects of unpolarised light that comes from index `outside` at that
/// cosine: of `thickness` and index `film`, on a base of complex index n + ik (Airy's sum).
/// >>> thin_film_reflectance(600nm, 1.0, 100nm, 1.5, 2.25)
/// 0
/// >>> thin_film_reflectance(550nm, 0.5, 0.0, 1.3, 1.5) / fresnel(0.5, 1.5)
/// 1
real thin_film_reflectance(
    real wavelength, cos_theta, thickness, film,
    complex base,
    real outside = 1.0
)
    c1   = saturate(abs(cos_theta));
    sine = outside * outside * (1.0 - c1 * c1);
    complex below(complex n) = sqrt(1.0 - sine / (n * n));
    c2   = below(film + 0i);
    c3   = below(base);
    turn = exp(2i * (tau * (thickness / wavelength) * film) * c2);
    real part(complex a, b) = abs((a + b * turn) / (1.0 + a * b * turn))^2;
    complex across(complex n, m, c, d) = (n * c - m * d) / (n * c + m * d);
    s = part(across(outside, film, c1, c2), across(film, base, c2, c3));
    p = part(across(film, outside, c1, c2), across(base, film, c2, c3));
    return 0.5 * (s + p);

/// `thin_film_reflectance` at each wavelength: soap bubbles, oil, tempered steel.
/// >>> thin_film(1.0, 0.0, 1.3, 1.5)
/// 0.04
spectrum thin_film(real cos_theta, thickness, film, complex base, real outside = 1.0) = spectral(
    function(l) -> thin_film_reflectance(l, cos_theta, thickness, film, base, outside)
);

/// The Abbe number of a glass whose refractive index is f(wavelength), a large one disperses little:
/// (n_d - 1) / (n_F - n_C) at the lines of helium at 587.56 nm and hydrogen at 486.13 and 656.27 nm.
/// >>> abbe_number(function(l) -> cauchy(l, 1.5046, 0.0042))
/// 64.4...
real abbe_number(function(real) -> real f) =
    (f(587.5618nm) - 1.0) / (f(486.1327nm) - f(656.2725nm));

/// The refractive index of a glass of index `n` at 587.56 nm and Abbe number `v`, by Cauchy's formula
/// of two terms.
/// >>> abbe_number(function(l) -> abbe_index(l, 1.6, 40.0))
/// 40
real abbe_index(real wavelength, n, v)
    // 1 / F^2 - 1 / C^2 and 1 / d^2, in 1 / um^2
    b = (n - 1.0) / (v * 1.90962463);
    return cauchy(wavelength, n - 2.89662914 * b, b);

/// `abbe_index` at each wavelength: `dielectric(abbe_glass(1.6, 40))`.
/// >>> abbe_glass(1.5, 1e9)
/// 1.5
spectrum abbe_glass(real n, v) = spectral(function(l) -> abbe_index(l, n, v));

/// What share of light is left after `distance` through a medium of that absorption, per metre
/// (Beer and Lambert); all of it through nothing, however strong.
/// >>> transmittance(0.5, 2.0)
/// 0.3678...
spectrum transmittance(spectrum absorption, real distance) = exp(-absorption * distance);

/// The absorption, per metre, that leaves `colour` of white light after `distance`; colours below a
/// millionth count as a millionth.
/// >>> absorption_from(rgb(0.5, 0.5, 0.5), 2.0)
/// 0.34657359
spectrum absorption_from(spectrum colour, real distance) =
    -log(max(min(colour, 1.0), 1e-6)) / distance;
