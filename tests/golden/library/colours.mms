// Colours: hue, saturation, sRGB; nothing leaves [0, 1].
const a0 = to_hsv([0.2, 0.7, 0.4]);                 // expect: [0.39999999999999997, 0.7142857142857143, 0.7]
const a1 = to_hsv([0.7, 0.2, 0.4]);                 // expect: [0.9333333333333333, 0.7142857142857143, 0.7]
const a2 = [to_hsv([0, 0, 0]), to_hsv([1, 1, 1])];  // expect: [0, 0, 0, 0, 0, 1]
const a3 = hsv(0.83, 0.3, 0.9);                     // expect: [0.8946, 0.63, 0.9]
const a4 = hsv(-0.17, 0.3, 0.9);                    // expect: [0.8946, 0.63, 0.9]
const a5 = turn_hue([0.2, 0.7, 0.4], 0.5);          // expect: [0.7, 0.19999999999999998, 0.5000000000000002]
const a6 = length(turn_hue([2, -1, 0], 0) - [1, 0, 0]) < 1e-6;  // expect: true
const a7 = luminance(strengthen([0.2, 0.7, 0.4], 1.2)) - luminance([0.2, 0.7, 0.4]) < 1e-6;  // expect: true
const a8 = strengthen([0.2, 0.7, 0.4], 1);  // expect: [0.2, 0.7, 0.4]
const a9 = strengthen([0.5, 0.5, 0.5], 9);  // expect: [0.5, 0.5, 0.5]
const b0 = [strengthen([0, 0, 0], 9), strengthen([1, 1, 1], 9)];  // expect: [0, 0, 0, 1, 1, 1]
const b1 = [from_srgb(0), from_srgb(0.04045), from_srgb(1)];  // expect: [0, 0.0031308049535603713, 1]
const b2 = [to_srgb(0), to_srgb(0.0031308), to_srgb(0.5), to_srgb(1)];  // expect: [0, 0.040449936, 0.7353569830524495, 1]
// Of curves over the wavelength: the hue of the light that they reflect, off by that many turns.
real band(real l, centre) = 0.1 + 0.8 * exp(-0.5 * ((l - centre) / 40nm)^2);
real hue(real centre, turns) =
    to_hsv(rgb_of_xyz(xyz_of(function(l) -> band(turned_wavelength(l, turns), centre))))[0];
real off(real centre, turns) =
    abs(fract(hue(centre, turns) - hue(centre, 0.0) - turns + 0.5) - 0.5);
const c1 = fold(#max, 0, array(7, function(k) -> off(550nm, k / 6.0))) < 0.1;  // expect: true
const c2 = fold(#max, 0, array(7, function(k) -> off(640nm, k / 6.0))) < 0.1;  // expect: true
spectrum same() = turn_hue(function(l) -> 0.25, 0.3);       // expect: [0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25]
spectrum cut() = strengthen(rgb(0.9, 0.9, 0.9), 3.0, 0.5);  // expect: [1, 1, 1, 1, 1, 1, 1, 1]
spectrum grey() = strengthen(function(l) -> 0.3, 7.0);      // expect: [0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3]
