// SPDX-License-Identifier: Apache-2.0
// Constants and shaping functions that every script can use.

/// Half a turn, in radians.
const real pi = 3.14159265358979323846;

/// A whole turn, in radians.
const real tau = 6.28318530717958647693;

/// The base of the natural logarithm.
const real e = 2.71828182845904523536;

/// `a` at t = 0, `b` at t = 1, straight between and beyond.
generic T mix(generic T a, b, real t) = a + (b - a) * t;

/// `mix` of numbers; integers widen.
real mix(real a, b, t) = a + (b - a) * t;

/// x limited to [0, 1].
real saturate(real x) = clamp(x, 0.0, 1.0);

/// 0 where x is below `edge`, else 1.
real step(real edge, x) = select 0.0, if x < edge; 1.0 otherwise; end;

/// 1 from `a` (included) to `b` (not included), else 0.
real pulse(real a, b, x) = step(a, x) - step(b, x);

/// 0 below `a`, 1 above `b`, a straight line between.
real linearstep(real a, b, x) = saturate((x - a) / (b - a));

/// 0 below `a`, 1 above `b`, between them the cubic that is level at both.
real smoothstep(real a, b, x)
    t = linearstep(a, b, x);
    return t * t * (3.0 - 2.0 * t);

/// The number that stands to [c, d] as x does to [a, b].
real remap(real x, a, b, c, d) = c + (x - a) * ((d - c) / (b - a));

/// Bends [0, 1] on itself so that 1/2 becomes `amount`, in (0, 1) (Schlick 1994).
real bias(real x, amount) = x / ((1.0 / amount - 2.0) * (1.0 - x) + 1.0);

/// Steepens (`amount` above 1/2) or flattens the middle of [0, 1], which keeps 0, 1/2 and 1 (Schlick 1994).
real gain(real x, amount) = select
    0.5 * bias(2.0 * x, 1.0 - amount), if x < 0.5;
    1.0 - 0.5 * bias(2.0 - 2.0 * x, 1.0 - amount) otherwise;
end;

/// a - b floor(a / b), as `a % b`: has the sign of b.
real mod(real a, b) = a % b;
