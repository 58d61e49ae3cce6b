// SPDX-License-Identifier: Apache-2.0
// Reflectances of colours as smooth curves: a quadratic of the wavelength, bent into [0, 1] by a
// sigmoid (Jakob and Hanika 2019). Its three coefficients are found where they are needed, by the
// method of Levenberg and Marquardt: at link for a constant colour.

/// From all reals into (0, 1): 1/2 + x / (2 sqrt(1 + x^2)).
/// >>> sigmoid(0.0)
/// 0.5
real sigmoid(real x) = 0.5 + 0.5 * x / sqrt(1.0 + x * x);

/// Where the curve of `rgb_sigmoid` is known: 36 wavelengths from 385 nm on, 10 nm apart, in 100 nm
/// from 550 nm.
/// >>> sigmoid_place(0)
/// -1.65
real sigmoid_place(integer k) = 0.1 * k - 1.65;

/// What is seen under D65 of a reflectance of 1 in the 10 nm around place k, but for a factor.
/// >>> sigmoid_seen(17)[1] > sigmoid_seen(17)[0]
/// true
real[3] sigmoid_seen(integer k)
    l = 550nm + 100nm * sigmoid_place(k);
    return illuminant_d65(l) * rgb_of_xyz([cie_x(l), cie_y(l), cie_z(l)]);

/// The sum of 36 things, by pairs.
/// >>> sigmoid_sum(array(36, function(k) -> k))
/// 630
T sigmoid_sum(generic T[36] a)
    b = array(18, function(k) -> a[k] + a[k + 18]);
    c = array(9, function(k) -> b[k] + b[k + 9]);
    d = array(3, function(k) -> c[k] + c[k + 3] + c[k + 6]);
    return d[0] + d[1] + d[2];

/// The share of place k in red, green and blue; all of them are 1 together, up to rounding.
/// >>> sigmoid_sum(array(36, #sigmoid_share)) - 1
/// [0, 0, 0]
real[3] sigmoid_share(integer k) =
    sigmoid_seen(k) / [10.570649230912668, 10.564492702017958, 10.571284790388383];

/// Red, green and blue under D65 of the curve with those coefficients.
/// >>> sigmoid_colour([0, 0, 0])
/// [0.5, 0.5, 0.5]
real[3] sigmoid_colour(real[3] c) = sigmoid_sum(array(36, function(k) ->
    sigmoid((c[0] * sigmoid_place(k) + c[1]) * sigmoid_place(k) + c[2]) * sigmoid_share(k)));

/// How `sigmoid_colour` changes with each coefficient: a row of red, green and blue for each.
/// >>> sigmoid_slopes([0, 0, 0])[2]
/// [0.5, 0.5, 0.5]
real[3, 3] sigmoid_slopes(real[3] c)
    real[3] slope(integer k)
        x = (c[0] * sigmoid_place(k) + c[1]) * sigmoid_place(k) + c[2];
        q = 1.0 + x * x;
        return 0.5 / (q * sqrt(q)) * sigmoid_share(k);
    slopes = array(36, #slope);
    return array(3, function(r) ->
        sigmoid_sum(array(36, function(k) -> sigmoid_place(k)^(2 - r) * slopes[k])));

/// The coefficients whose curve is nearest to `colour`, from `c` on, in at most `left` steps; `scale`
/// weighs errors of red, green and blue.
/// >>> sigmoid_search(0, [1, 2, 3], [0, 0, 0], [1, 1, 1])
/// [1, 2, 3]
real[3] sigmoid_search(integer left, real[3] c, colour, scale)
    real[3] missing(real[3] at) = scale * (colour - sigmoid_colour(at));
    real[3] step(real[3] at, error, real damping)
        slopes = sigmoid_slopes(at);
        j      = array(3, function(r) -> scale * slopes[r]);
        m      = array(3, function(r) -> array(3, function(s) ->
            dot(j[r], j[s]) * select 1.0 + damping, if r == s; 1.0 otherwise end));
        return multiply(inverse(m + 1e-12 * identity(3)),
            array(3, function(r) -> dot(j[r], error)));
    real[3] from(integer more, real[3] at, error, real damping)
        next = at + step(at, error, damping);
        then = missing(next);
        good = dot(then, then) < dot(error, error);
        return select
            at, if more == 0 or dot(error, error) < 1e-9;
            from(more - 1, next, then, 0.2 * damping), if good;
            from(more - 1, at, error, 5.0 * damping) otherwise;
        end;
    return from(left, c, missing(c), 0.1);

/// The coefficients of the curve that has a colour of [0, 1] under D65.
/// >>> sigmoid_coefficients([0.5, 0.5, 0.5])
/// [0, 0, 0]
real[3] sigmoid_coefficients(real[3] colour)
    goal = map(#saturate, colour);
    real start(real v)
        t = 2.0 * clamp(v, 0.1, 0.9) - 1.0;
        return t / sqrt(1.0 - t * t);
    // first the curve through the colour at 610, 545 and 450 nm
    x     = map(#start, goal);
    rg    = (x[0] - x[1]) / 0.65;
    gb    = (x[1] - x[2]) / 0.95;
    a     = (rg - gb) / 1.6;
    b     = rg - 0.55 * a;
    // errors as the eye sees them: lightness is nearly a cube root
    scale = map(function(v) -> 1.0 / (cbrt(v * v) + 0.01), goal);
    return sigmoid_search(40, [a, b, x[0] - 0.6 * (b + 0.6 * a)], goal, scale);

/// The reflectance of linear red, green and blue in [0, 1] as a smooth curve. Under D65 it comes back
/// as that colour: over the sRGB cube off by 0.03 of Delta E in the mean, where `rgb` is off by 6.
/// A constant colour is solved at link; one that varies takes about 1 us a point, `rgb` some nanoseconds.
/// >>> abs(luminance(rgb_sigmoid(0.5, 0.5, 0.5)) - 0.5) < 1e-5
/// true
spectrum rgb_sigmoid(real r, g, b)
    c = sigmoid_coefficients([r, g, b]);
    u = ($wavelength - 550nm) / 100nm;
    x = (c[0] * u + c[1]) * u + c[2];
    return 0.5 + 0.5 * x / sqrt(1.0 + x * x);

/// `rgb_sigmoid` of an array.
/// >>> abs(luminance(rgb_sigmoid([0.5, 0.5, 0.5])) - 0.5) < 1e-5
/// true
spectrum rgb_sigmoid(real[3] c) = rgb_sigmoid(c[0], c[1], c[2]);
