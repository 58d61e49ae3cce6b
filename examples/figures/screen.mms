// How a number comes out on the screen.

/// The light that a picture shows as `value`, 0 black to 1 white: the inverse of what a render does
/// to luminance (docs/scene.md, Pictures) and of the screen's own curve.
/// >>> screen(0.0) / $wavelength
/// 0
spectrum screen(real value) =
    log2(1.0 - min(from_srgb(saturate(value)), 0.998)) / -1.7 * illuminant_d65($wavelength);

/// A number of [-1, 1] from black to white.
/// >>> screen_signed(-1.0) / $wavelength
/// 0
spectrum screen_signed(real value) = screen(0.5 + 0.5 * value);

/// The reflectance of a colour, lit in full.
/// >>> screen_colour(rgb(0, 0, 0)) / $wavelength
/// 0
spectrum screen_colour(spectrum colour) = 1.5 * colour * illuminant_d65($wavelength);

/// Two numbers of [-1, 1] as red and green.
/// >>> screen_pair([1, 1]) / screen_colour(rgb(0.7, 0.7, 0.15))
/// 1
spectrum screen_pair(real[2] v) =
    screen_colour(rgb(map(#saturate, [0.35 + 0.35 * v[0], 0.35 + 0.35 * v[1], 0.15])));
