// Thesis Figure 4.5: copper in white light and in a band of 535 to 595 nm, only the diffuse part, by
// the full spectrum and as three numbers do it: what is reflected at 645, 526 and 444 nm times the
// light's red, green and blue. Light and copper are one reflectance here, under the lamp's D65.
//
//   mms render copper.mms --scene copper.json --max-depth 1 -o copper.png
//
// Left white light, right the band; above by three numbers, below by the full spectrum.

/// What smooth copper reflects of light that falls on it straight, at wavelengths.
/// >>> copper_reflected(645nm) > copper_reflected(444nm)
/// true
T copper_reflected(generic T wavelength) = reflected(copper_n(wavelength), copper_k(wavelength));

T reflected(generic T n, T k) = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2);

// The band: a triangle over 535 to 595 nm, over the power of D65.
const spectrum band = max(1 - abs($wavelength - 565nm) / 30nm, 0) / illuminant_d65($wavelength);

surface white_three
    bsdf = matte(rgb(copper_reflected(645nm), copper_reflected(526nm), copper_reflected(444nm)));
end

surface band_three
    // The band is (0.207, 0.320, -0.043) in linear sRGB; three numbers cannot be below 0.
    bsdf = matte(rgb(0.207 * copper_reflected(645nm), 0.320 * copper_reflected(526nm), 0));
end

surface white_full
    bsdf = matte(copper_reflected($wavelength));
end

surface band_full
    bsdf = matte(copper_reflected($wavelength) * band);
end
