// SPDX-License-Identifier: Apache-2.0
// Complex numbers, as far as the language itself can say them.

/// Real part: `z.re`.
/// >>> re(1 + 2i)
/// 1
real re(complex z) = z.re;

/// Imaginary part: `z.im`.
/// >>> im(1 + 2i)
/// 2
real im(complex z) = z.im;

/// The number with its imaginary part negated.
/// >>> conj(0.5 + 0.25i)
/// 0.5 - 0.25i
complex conj(complex z) = complex(z.re, -z.im);

/// Angle in [-pi, pi], with the sign of a zero imaginary part.
/// >>> arg(1 + 1i) / 1deg
/// 45
real arg(complex z) = atan2(z.im, z.re);

/// Modulus, without overflow; infinite where either part is.
/// >>> abs(3 + 4i)
/// 5
real abs(complex z) = hypot(z.re, z.im);

/// r (cos phi + i sin phi), phi in radians.
/// >>> polar(2, 0)
/// 2
complex polar(real r, phi) = complex(r * cos(phi), r * sin(phi));

/// a / b, which the operator `/` calls: Smith's division, so that nothing overflows on the way that
/// does not in the end.
/// >>> complex_divide(1 + 2i, 3 + 4i)
/// 0.44 + 0.08i
complex complex_divide(complex a, b)
    wide  = abs(b.re) >= abs(b.im);
    large = select b.re, if wide; b.im otherwise end;
    small = select b.im, if wide; b.re otherwise end;
    ratio = small / large;
    scale = large + small * ratio;
    re    = select a.re + a.im * ratio, if wide; a.re * ratio + a.im otherwise end;
    im    = select a.im - a.re * ratio, if wide; a.im * ratio - a.re otherwise end;
    return complex(re / scale, im / scale);
