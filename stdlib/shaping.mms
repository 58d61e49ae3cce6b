// SPDX-License-Identifier: Apache-2.0
// Steps, waves, splines and ramps. Where there is a `width`, the value is the mean over an interval
// as wide around x (a box filter), which is exact; 0 is the plain function, and so is in waves less
// than a ten-thousandth, where differences of floats would be left.

/// The mean of `step` over `width`.
/// >>> step(0.5, 0.6, 0.4)
/// 0.75
real step(real edge, x, width) =
    select step(edge, x), if width <= 0.0; saturate((x - edge) / width + 0.5) otherwise; end;

/// The mean of `pulse` over `width`.
/// >>> pulse(0.0, 1.0, 0.5, 4.0)
/// 0.25
real pulse(real a, b, x, width) = select
    pulse(a, b, x), if width <= 0.0;
    max(min(b - x, 0.5 * width) - max(a - x, -0.5 * width), 0.0) / width otherwise;
end;

/// The mean of `linearstep` over `width`; a < b.
/// >>> linearstep(0.0, 1.0, 0.0, 1.0)
/// 0.125
real linearstep(real a, b, x, width)
    h     = 0.5 * width;
    low   = clamp(-h, a - x, b - x);
    high  = clamp(h, a - x, b - x);
    ramp  = (high - low) * ((x - a + 0.5 * (high + low)) / max(b - a, 1e-30));
    above = h - clamp(b - x, -h, h);
    return select linearstep(a, b, x), if width <= 0.0; (ramp + above) / width otherwise; end;

/// 0 below `a`, 1 above `b`, between them the quintic that is level and straight at both (Perlin 2002).
/// >>> smootherstep(0.0, 1.0, 0.25)
/// 0.103515625
real smootherstep(real a, b, x)
    t = linearstep(a, b, x);
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);

/// x pulled away from `pivot` by a factor: above 1 steeper, between 0 and 1 flatter.
/// >>> contrast(0.75, 2.0)
/// 1
real contrast(real x, amount, pivot = 0.5) = pivot + (x - pivot) * amount;

/// The smaller of two, rounded off where they are nearer than `k` > 0: at most k / 4 below.
/// >>> smooth_min(1.0, 1.0, 0.4)
/// 0.9
real smooth_min(real a, b, k)
    h = max(k - abs(a - b), 0.0) / k;
    return min(a, b) - 0.25 * k * h * h;

/// The larger of two, rounded off where they are nearer than `k` > 0: at most k / 4 above.
/// >>> smooth_max(1.0, 1.0, 0.4)
/// 1.1
real smooth_max(real a, b, k) = -smooth_min(-a, -b, k);

/// A wave of period 1 that grows from 0 to 1 and falls at once: `fract`, filtered.
/// >>> saw(2.25)
/// 0.25
/// >>> saw(2.25, 3.0)
/// 0.5
real saw(real x, width = 0.0)
    real integral(real t) = 0.5 * (floor(t) + fract(t) * fract(t));
    f = fract(x);
    return select
        f, if width < 1e-4;
        (integral(f + 0.5 * width) - integral(f - 0.5 * width)) / width otherwise;
    end;

/// A wave of period 1 that grows from 0 to 1 at one half, and falls again.
/// >>> triangle(0.25)
/// 0.5
/// >>> triangle(0.5, 1.0)
/// 0.5
real triangle(real x, width = 0.0)
    real rest(real t) = select t * t, if t < 0.5; 2.0 * t - t * t - 0.5 otherwise; end;
    real integral(real t) = 0.5 * floor(t) + rest(fract(t));
    f = fract(x);
    return select
        1.0 - abs(1.0 - 2.0 * f), if width < 1e-4;
        (integral(f + 0.5 * width) - integral(f - 0.5 * width)) / width otherwise;
    end;

/// Element `k` of the array, counted from 0; the nearest end where there is none. It may hold
/// materials.
/// >>> choose(1, [0.2, 0.5, 0.9])
/// 0.5
T choose(integer k, generic T[n] values) = values[k];

/// The polyline through the values, which stand at 0, 1 / (n - 1), ..., 1; level outside [0, 1].
/// >>> spline_linear(0.75, [0.0, 1.0, 3.0])
/// 2
T spline_linear(real t, generic T[n] values)
    x = saturate(t) * (n - 1);
    k = max(min(integer(x), n - 2), 0);
    return mix(values[k], values[min(k + 1, n - 1)], x - k);

/// `spline_linear` of numbers; integers widen.
/// >>> spline_linear(0.5, [0, 1, 4])
/// 1
real spline_linear(real t, real[n] values)
    x = saturate(t) * (n - 1);
    k = max(min(integer(x), n - 2), 0);
    return mix(values[k], values[min(k + 1, n - 1)], x - k);

/// The smooth curve through the values, which stand at 0, 1 / (n - 1), ..., 1: cubics whose slope at a
/// value is the mean of those on both sides (Catmull and Rom 1974); beyond the ends the values are
/// thought to go on straight. It may overshoot. Level outside [0, 1]; n at least 2.
/// >>> spline_catmull_rom(0.25, [0.0, 1.0, 0.0])
/// 0.625
T spline_catmull_rom(real t, generic T[n] values)
    x = saturate(t) * (n - 1);
    k = min(integer(x), n - 2);
    u = x - k;
    b = values[k];
    c = values[k + 1];
    a = select b + b - c, if k == 0; values[k - 1] otherwise; end;
    d = select c + c - b, if k >= n - 2; values[k + 2] otherwise; end;
    return b + (0.5 * u) * ((c - a)
        + u * ((2.0 * a - 5.0 * b + 4.0 * c - d) + u * (3.0 * (b - c) + (d - a))));

/// The cubic B-spline of the values: smoother, within their range, but through the first and last
/// only; beyond the ends the values are thought to go on straight. Level outside [0, 1]; n at least 2.
/// >>> spline_b(0.5, [0.0, 3.0, 0.0])
/// 2
T spline_b(real t, generic T[n] values)
    x = saturate(t) * (n - 1);
    k = min(integer(x), n - 2);
    u = x - k;
    v = 1.0 - u;
    b = values[k];
    c = values[k + 1];
    a = select b + b - c, if k == 0; values[k - 1] otherwise; end;
    d = select c + c - b, if k >= n - 2; values[k + 2] otherwise; end;
    return (v * v * v / 6.0) * a + (2.0 / 3.0 - u * u * (1.0 - 0.5 * u)) * b
        + (2.0 / 3.0 - v * v * (1.0 - 0.5 * v)) * c + (u * u * u / 6.0) * d;

/// Cubic Bezier curves, end to end: the values 0, 3, 6, ... are passed, the two between are handles.
/// n is 4, 7, 10, ...; each curve has the same share of [0, 1]; level outside.
/// >>> spline_bezier(0.5, [0.0, 1.0, 1.0, 0.0])
/// 0.75
T spline_bezier(real t, generic T[n] values)
    pieces = integer((n - 1) / 3);
    x      = saturate(t) * pieces;
    k      = min(integer(x), pieces - 1);
    u      = x - k;
    v      = 1.0 - u;
    return (v * v * v) * values[3 * k] + (3.0 * u * v * v) * values[3 * k + 1]
        + (3.0 * u * u * v) * values[3 * k + 2] + (u * u * u) * values[3 * k + 3];

/// The smooth curve through the values that never overshoots: it rises where they rise and falls
/// where they fall (Steffen 1990). They stand at 0, 1 / (n - 1), ..., 1; level outside; n at least 2.
/// >>> spline_monotone(0.5, [0.0, 0.0, 1.0, 1.0])
/// 0.5
real spline_monotone(real t, real[n] values) =
    ramp_monotone(t, array(n, function(k) -> k / max(n - 1, 1)), values);

/// Where in `knots`, which grow, t lies: the largest k at most n - 2 whose knot is not above t, or 0.
/// >>> knot_before(0.7, [0.0, 0.2, 0.6, 1.0])
/// 2
integer knot_before(real t, real[n] knots)
    integer upto(integer k) = select
        k, if k >= n - 2;
        k, if t < knots[k + 1];
        upto(k + 1) otherwise;
    end;
    return upto(0);

/// A colour ramp: `values[k]` at `knots[k]`, straight between, level outside. Equal knots make a jump.
/// >>> ramp(0.4, [0.0, 0.2, 0.6], [1.0, 2.0, 4.0])
/// 3
/// >>> ramp(0.5, [0.0, 1.0], [rgb(0, 0, 0), rgb(1, 1, 1)])
/// 0.5
T ramp(real t, real[n] knots, generic T[n] values)
    k     = knot_before(t, knots);
    l     = min(k + 1, n - 1);
    share = saturate((t - knots[k]) / max(knots[l] - knots[k], 1e-30));
    return mix(values[k], values[l], share);

/// As `ramp`, level at the knots: `smoothstep` between them.
/// >>> ramp_smooth(0.25, [0.0, 1.0], [0.0, 1.0])
/// 0.15625
T ramp_smooth(real t, real[n] knots, generic T[n] values)
    k = knot_before(t, knots);
    l = min(k + 1, n - 1);
    s = saturate((t - knots[k]) / max(knots[l] - knots[k], 1e-30));
    return mix(values[k], values[l], s * s * (3.0 - 2.0 * s));

/// As `ramp`, in steps: the value of the last knot that is not above t, the first below them all.
/// >>> ramp_steps(0.5, [0.0, 0.2, 0.6], [1.0, 2.0, 4.0])
/// 2
T ramp_steps(real t, real[n] knots, generic T[n] values)
    k = knot_before(t, knots);
    return select values[n - 1], if t >= knots[n - 1]; values[k] otherwise; end;

/// As `ramp` of numbers, smooth and without overshoot: Steffen's monotone cubics (1990).
/// The knots grow strictly; n at least 2.
/// >>> ramp_monotone(0.25, [0.0, 0.5, 1.0], [0.0, 1.0, 1.0])
/// 0.6875
real ramp_monotone(real t, real[n] knots, values)
    real rise(integer k) = (values[k + 1] - values[k]) / (knots[k + 1] - knots[k]);
    real bounded(real s, before, after) =
        (sign(before) + sign(after)) * min(min(abs(before), abs(after)), 0.5 * abs(s));
    real inner(integer k)
        g = knots[k] - knots[k - 1];
        h = knots[k + 1] - knots[k];
        return bounded((rise(k - 1) * h + rise(k) * g) / (g + h), rise(k - 1), rise(k));
    real limited(real s, chord) = select
        0.0, if s * chord <= 0.0;
        sign(chord) * min(abs(s), 2.0 * abs(chord)) otherwise;
    end;
    real first()
        a = knots[1] - knots[0];
        q = a / (knots[min(2, n - 1)] - knots[0]);
        return limited(rise(0) * (1.0 + q) - rise(min(1, n - 2)) * q, rise(0));
    real last()
        a = knots[n - 1] - knots[n - 2];
        q = a / (knots[n - 1] - knots[max(n - 3, 0)]);
        return limited(rise(n - 2) * (1.0 + q) - rise(max(n - 3, 0)) * q, rise(n - 2));
    real slope(integer k) = select
        first(), if k == 0;
        last(), if k == n - 1;
        inner(k) otherwise;
    end;
    k    = knot_before(t, knots);
    h    = knots[k + 1] - knots[k];
    x    = clamp(t - knots[k], 0.0, h);
    m    = rise(k);
    a    = slope(k);
    b    = slope(k + 1);
    high = (a + b - 2.0 * m) / (h * h);
    mid  = (3.0 * m - 2.0 * a - b) / h;
    return values[k] + x * (a + x * (mid + x * high));
