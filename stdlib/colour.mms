// SPDX-License-Identifier: Apache-2.0
// Colours as [red, green, blue], linear, of the primaries of sRGB. `rgb` makes spectra of them.

/// The luminance of a linear colour, that of white being 1 (ITU-R BT.709).
/// >>> luminance([1, 1, 1])
/// 1
real luminance(real[3] c) = dot(c, [0.2126, 0.7152, 0.0722]);

/// The luminance of a reflectance, as far as the wavelengths of the path tell: its mean, weighted by
/// the observer's `cie_y` (thesis 4.1, with the density of the wavelengths as a divisor). In [0, 1]
/// if the reflectance is; exact where it is constant, another number on each path where not.
/// >>> luminance(0.25 + 0 * $wavelength)
/// 0.25
real luminance(spectrum s)
    // the inverse of the density of the path's wavelengths (thesis 4.8)
    real spread(real l) = cosh(7.2e6 * (l - 538nm))^2;
    weight = intrinsic::values(cie_y($wavelength) * spectral(#spread));
    value  = intrinsic::values(s);
    mean   = dot(weight, value) / fold(#+, 0, weight);
    // a mean is between what it is the mean of, however it was rounded
    return clamp(mean, fold(#min, value[0], value), fold(#max, value[0], value));

/// [red, green, blue], linear, of [X, Y, Z] (IEC 61966-2-1; white is D65).
/// >>> rgb_of_xyz([0.95, 1, 1.09])
/// [0.998..., 1.000..., 1.000...]
real[3] rgb_of_xyz(real[3] c) = multiply([
    3.2409699419045213, -1.5373831775700935, -0.4986107602930033;
    -0.9692436362808798, 1.8759675015077206, 0.0415550574071756;
    0.0556300796969936, -0.2039769588889765, 1.0569715142428786
], c);

/// [X, Y, Z] of linear [red, green, blue]; that of white has Y = 1.
/// >>> xyz_of_rgb([1, 1, 1])
/// [0.950..., 1, 1.089...]
real[3] xyz_of_rgb(real[3] c) = multiply([
    0.4123907992659595, 0.357584339383878, 0.1804807884018343;
    0.2126390058715104, 0.715168678767756, 0.0721923153607337;
    0.0193308187155918, 0.119194779794626, 0.9505321522496607
], c);

/// [x, y]: the chromaticity of [X, Y, Z]; that of black is [0, 0].
/// >>> chromaticity([1, 1, 2])
/// [0.25, 0.25]
real[2] chromaticity(real[3] xyz)
    sum = xyz[0] + xyz[1] + xyz[2];
    return select [0, 0], if sum == 0.0; [xyz[0] / sum, xyz[1] / sum] otherwise; end;

/// The linear number of a value of sRGB, both in [0, 1] (IEC 61966-2-1).
/// >>> from_srgb(0.5)
/// 0.214...
real from_srgb(real v) =
    select v / 12.92, if v <= 0.04045; pow((v + 0.055) / 1.055, 2.4) otherwise; end;

/// The value of sRGB of a linear number, both in [0, 1].
/// >>> to_srgb(from_srgb(0.5))
/// 0.5
real to_srgb(real x) =
    select 12.92 * x, if x <= 0.0031308; 1.055 * pow(x, 1.0 / 2.4) - 0.055 otherwise; end;

/// The reflectance of a colour as picture programs name it: red, green and blue of sRGB in [0, 255].
/// >>> srgb(255, 255, 255)
/// 1
spectrum srgb(real r, g, b) = rgb(map(#from_srgb, [r / 255.0, g / 255.0, b / 255.0]));

/// [hue, saturation, value] of a colour in [0, 1]: hue in turns from red, in [0, 1) (Smith 1978).
/// >>> to_hsv([0, 0.5, 0])
/// [0.33333333, 1, 0.5]
real[3] to_hsv(real[3] c)
    high = max(c[0], max(c[1], c[2]));
    span = high - min(c[0], min(c[1], c[2]));
    hue  = select
        0.0, if span <= 0.0;
        (c[1] - c[2]) / span, if c[0] == high;
        2.0 + (c[2] - c[0]) / span, if c[1] == high;
        4.0 + (c[0] - c[1]) / span otherwise;
    end;
    return [fract(hue / 6.0), select 0.0, if high <= 0.0; span / high otherwise end, high];

/// The colour of that hue, in turns from red, saturation and value; all in [0, 1] if the last two are.
/// >>> hsv(1 / 3, 1, 0.5)
/// [0, 0.5, 0]
real[3] hsv(real hue, saturation, value) = array(3, function(k) ->
    value * (1.0 - saturation * saturate(2.0 - abs(6.0 * fract(hue - k / 3.0) - 3.0))));

/// A colour in [0, 1] with its hue turned on, in turns; stays in [0, 1].
/// >>> turn_hue([0.5, 0, 0], 1 / 3)
/// [0, 0.5, 0]
real[3] turn_hue(real[3] c, real turns)
    h = to_hsv(map(#saturate, c));
    return hsv(h[0] + turns, h[1], h[2]);

/// A colour in [0, 1], its distance from the grey of its luminance times `amount`, at least 0: 0 is
/// that grey, 1 the colour, more is stronger, as far as there is room in [0, 1].
/// >>> strengthen([0.2, 0.4, 0.6], 0.0) == luminance([0.2, 0.4, 0.6]) * [1, 1, 1]
/// true
/// >>> strengthen([1, 0, 0], 5.0)
/// [1, 0, 0]
real[3] strengthen(real[3] c, real amount)
    grey = luminance(map(#saturate, c));
    away = map(#saturate, c) - grey;
    real room(real d) = select
        (1.0 - grey) / d, if d > 0.0;
        grey / -d, if d < 0.0;
        amount otherwise;
    end;
    most = min(room(away.x), min(room(away.y), room(away.z)));
    return map(#saturate, grey + min(amount, most) * away);

/// A reflectance in [0, 1], its distance from `grey` times `amount`, at least 0, and cut off at 0 and 1.
/// >>> strengthen(0.5 + 0 * $wavelength, 2.0, 0.4)
/// 0.6
spectrum strengthen(spectrum s, real amount, grey) =
    clamp(grey + max(amount, 0.0) * (s - grey), 0.0, 1.0);

/// The same, away from the luminance of the reflectance as far as the wavelengths of the path tell; see
/// `luminance`. `strengthen` of a function knows it whole.
/// >>> strengthen(0.25 + 0 * $wavelength, 2.0)
/// 0.25
spectrum strengthen(spectrum s, real amount) = strengthen(s, amount, luminance(s));

/// The same of a reflectance that is a function of the wavelength in metres, away from its luminance.
/// >>> strengthen(function(l) -> measured("file.csv", l), 1.5)
spectrum strengthen(function(real) -> real f, real amount) =
    strengthen(spectral(f), amount, xyz_of(f)[1]);

/// The wavelength that many turns back along the circle of hues, from blue to green and red: the light
/// from 400 to 700 nm, closed by purple. In metres.
/// >>> turned_wavelength(450nm, 1 / 3) / 1nm
/// 550
real turned_wavelength(real wavelength, turns) =
    400nm + 300nm * fract((wavelength - 400nm) / 300nm + turns);

/// A reflectance that is a function of the wavelength in metres, its hue turned on, in turns as those
/// of `hsv`: the curve slides along the circle of `turned_wavelength`. Stays in [0, 1] if the curve does; it
/// may jump at 400 and 700 nm. The hue of a band 40 nm wide comes out within a tenth of a turn.
/// >>> turn_hue(function(l) -> 0.25, 1 / 3)
/// 0.25
spectrum turn_hue(function(real) -> real f, real turns) =
    spectral(function(l) -> f(turned_wavelength(l, turns)));
