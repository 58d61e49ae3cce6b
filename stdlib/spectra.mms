// SPDX-License-Identifier: Apache-2.0
// Spectra: colours, black bodies, bands. Emission is in W m^-2 sr^-1 nm^-1.

/// The reflectance of linear red, green and blue in [0, 1] (thesis Table 6.1); equal parts give a grey
/// exactly. Other colours come back a little changed; `rgb_sigmoid` keeps them.
/// >>> rgb(0.5, 0.5, 0.5)
/// 0.5
spectrum rgb(real r, g, b) = b + (r - b) * $rgb_red + (g - b) * $rgb_green;

/// `rgb` of an array.
/// >>> rgb([0.2, 0.2, 0.2])
/// 0.2
spectrum rgb(real[3] c) = rgb(c[0], c[1], c[2]);

/// Radiance of a black body at a temperature in kelvin.
/// >>> blackbody(6000.0) / planck($wavelength, 6000.0)
/// 1
spectrum blackbody(real temperature) = planck($wavelength, temperature);

/// The colour of a black body: its radiance over that at its peak (Wien's law); 0 at and below 0 K.
/// >>> blackbody_normalised(0.0)
/// 0
spectrum blackbody_normalised(real temperature)
    peak = planck(2.897771955e-3 / max(temperature, 1.0), max(temperature, 1.0));
    return planck($wavelength, temperature) / peak;

/// The colour matching functions of the CIE 1931 observer, x, y and z, at a wavelength in metres or at
/// each of a spectrum; 0 outside 360 to 830 nm (CIE 15, 1 nm steps).
/// >>> cie_y(555nm)
/// 1
T cie_y(generic T wavelength) = optical_table(wavelength, 1);

/// See `cie_y`.
/// >>> cie_x(600nm)
/// 1.0622
T cie_x(generic T wavelength) = optical_table(wavelength, 0);

/// See `cie_y`.
/// >>> cie_z(445nm)
/// 1.7826
T cie_z(generic T wavelength) = optical_table(wavelength, 2);

/// Relative power of CIE standard illuminant D65, noon daylight, 1 at 560 nm: `emission =
/// illuminant_d65($wavelength)`. In metres; 300 to 830 nm in steps of 5, level outside (CIE 15).
/// >>> illuminant_d65(560nm)
/// 1
T illuminant_d65(generic T wavelength) = optical_table(wavelength, 3);

/// Relative power of CIE standard illuminant A, a tungsten lamp of 2856 K; as `illuminant_d65`.
/// >>> illuminant_a(560nm)
/// 1
T illuminant_a(generic T wavelength) = optical_table(wavelength, 4);

/// Relative power of the CIE's illuminant F1 to F12, a fluorescent lamp: `illuminant_f(wavelength, 11)`.
/// F2 is cool white, F7 imitates daylight, F11 has three narrow bands. 1 at 560 nm; 380 to 780 nm in
/// steps of 5, level outside (CIE 15).
/// >>> illuminant_f(560nm, 7)
/// 1
T illuminant_f(generic T wavelength, integer number) =
    optical_table(wavelength, 7 + clamp(number, 1, 12))
    / optical_table(560nm, 7 + clamp(number, 1, 12));

/// Equal power at every wavelength: CIE illuminant E.
/// >>> illuminant_e(550nm)
/// 1
T illuminant_e(generic T wavelength) = 1.0 + 0.0 * wavelength;

/// Relative power of daylight of a correlated colour temperature, 4000 K to 25000 K, 1 at 560 nm
/// (CIE 15). D50 is that of 5003 K, D65 of 6504 K.
/// >>> illuminant_d(560nm, 5003K)
/// 1
T illuminant_d(generic T wavelength, real temperature)
    u = 1000.0 / clamp(temperature, 4000.0, 25000.0);
    x = select
        0.244063 + u * (0.09911 + u * (2.9678 - 4.6070 * u)), if temperature <= 7000.0;
        0.237040 + u * (0.24748 + u * (1.9018 - 2.0064 * u)) otherwise;
    end;
    y  = -3.0 * x * x + 2.870 * x - 0.275;
    m  = 0.0241 + 0.2562 * x - 0.7341 * y;
    m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    return optical_table(wavelength, 5) + m1 * optical_table(wavelength, 6)
        + m2 * optical_table(wavelength, 7);

/// The light of a colour: `rgb` times D65, the white of sRGB.
/// >>> rgb_light(2, 2, 2) / illuminant_d65($wavelength)
/// 2
spectrum rgb_light(real r, g, b) = rgb(r, g, b) * illuminant_d65($wavelength);

/// `rgb_light` of an array.
/// >>> rgb_light([2, 2, 2]) / illuminant_d65($wavelength)
/// 2
spectrum rgb_light(real[3] c) = rgb(c) * illuminant_d65($wavelength);

/// Radiance of the sun's disc, seen through clear air under that `elevation` above the horizon, in
/// radians: a black body of 5772 K behind the molecules of air and haze, `turbidity` of which is 2
/// on a clear day (Preetham, Shirley and Smits 1999; without ozone and water).
/// >>> luminance(sunlight(90deg) / blackbody(5772.0))
/// 0.8...
spectrum sunlight(real elevation, turbidity = 2.0)
    height = max(elevation, 0.0);
    mass   = 1.0 / (sin(height) + 0.50572 * pow(height / 1deg + 6.07995, -1.6364));
    haze   = max(0.04608 * turbidity - 0.04586, 0.0);
    um     = $wavelength * 1e6;
    return blackbody(5772.0) * exp(-mass * (0.008735 * pow(um, -4.08) + haze * pow(um, -1.3)));

/// [X, Y, Z] of a curve over the wavelength in metres, by sums of 5 nm; that of f = 1 has Y = 1.
/// >>> xyz_of(#illuminant_e)
/// [1.000..., 1, 1.000...]
real[3] xyz_of(function(real) -> real f)
    real[3] seen(real l) = [cie_x(l), cie_y(l), cie_z(l)];
    real[3] from(real nm, real[3] total) = select
        total, if nm > 830.0;
        from(nm + 5.0, total + f(nm * 1e-9) * seen(nm * 1e-9)) otherwise;
    end;
    real weight(real nm, total) = select
        total, if nm > 830.0;
        weight(nm + 5.0, total + cie_y(nm * 1e-9)) otherwise;
    end;
    return from(360.0, [0, 0, 0]) / weight(360.0, 0.0);

/// A bell around `centre` of standard deviation `width`, 1 at the centre; both wavelengths in metres.
/// >>> gaussian_band(550nm, 1m)
/// 1
spectrum gaussian_band(real centre, width)
    d = ($wavelength - centre) / width;
    return exp(-0.5 * d * d);

/// f of each wavelength, in metres: any function of a real becomes a spectrum.
/// >>> spectral(function(l) -> 2 * l) / $wavelength
/// 2
spectrum spectral(function(real) -> real f) = intrinsic::spectral(f, $wavelength);

/// f of each value of a spectrum.
/// >>> spectral(#sqrt, rgb(0.25, 0.25, 0.25))
/// 0.5
spectrum spectral(function(real) -> real f, spectrum s) = intrinsic::spectral(f, s);

/// A triangle around `centre`, 1 at the centre and 0 from `width` away on; in metres.
/// >>> triangular_band(550nm, 1000m)
/// 1
spectrum triangular_band(real centre, width) = max(1.0 - abs($wavelength - centre) / width, 0.0);

/// A table of measured values: `values[k]` at the wavelength `wavelengths[k]`, in metres and growing;
/// straight between, level outside; n at least 2. `measured` reads one from a file.
/// >>> tabulated([400nm, 700nm], [0.5, 0.5])
/// 0.5
spectrum tabulated(real[n] wavelengths, values)
    spectrum passed(integer k)
        width = max(wavelengths[k + 1] - wavelengths[k], 1e-30);
        return clamp(($wavelength - wavelengths[k]) / width, 0.0, 1.0);
    return fold(#+, spectrum(values[0]), array(n - 1, function(k) ->
        (values[k + 1] - values[k]) * passed(k)));

/// A table of a text file at a wavelength in metres: `emission = measured("lamp.csv", $wavelength)`. A row
/// a line, the wavelength first, separated by blanks, commas, semicolons or tabs; `#` begins a remark,
/// a line of words names the columns. `unit` is that of the wavelengths: `nm`, `um`, `m`. `column` is a
/// name or a place, the wavelengths being 0; left out, it is 1. Straight between, level outside.
/// >>> measured("file.csv", 550nm, unit = "um", column = "k")
real measured(string file, real wavelength, string unit = "nm", column = "") =
    curve_value(intrinsic::curve(file, unit, column), wavelength);

/// `measured` at each wavelength of a spectrum.
/// >>> conductor(measured("gold.csv", $wavelength, "um", "n"), measured("gold.csv", $wavelength, "um", "k"))
spectrum measured(string file, spectrum wavelength, string unit = "nm", column = "") =
    spectral(function(l) -> measured(file, l, unit, column), wavelength);
