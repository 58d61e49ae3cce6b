// SPDX-License-Identifier: Apache-2.0
// Constants and shaping functions that every script can use.

/// Half a turn, in radians.
/// >>> cos(pi)
/// -1
const real pi = 3.14159265358979323846;

/// A whole turn, in radians.
/// >>> sin(tau / 4)
/// 1
const real tau = 6.28318530717958647693;

/// The base of the natural logarithm.
/// >>> log(e)
/// 1
const real e = 2.71828182845904523536;

/// `a` at t = 0, `b` at t = 1, straight between and beyond.
/// >>> mix([0.0, 1.0], [1.0, 3.0], 0.5)
/// [0.5, 2]
generic T mix(generic T a, b, real t) = a + (b - a) * t;

/// `mix` of numbers; integers widen.
/// >>> mix(2, 4, 0.25)
/// 2.5
real mix(real a, b, t) = a + (b - a) * t;

/// `mix` of arrays of numbers, element by element.
/// >>> mix([0, 2], [1, 4], 0.5)
/// [0.5, 3]
real[n] mix(real[n] a, b, real t) = a + (b - a) * t;

/// `mix` of matrices of numbers.
/// >>> mix([1, 0; 0, 1], [0, 1; 1, 0], 0.25)
/// [0.75, 0.25, 0.25, 0.75]
real[r, c] mix(real[r, c] a, b, real t) = a + (b - a) * t;

/// The array [f(0), f(1), ...] of n elements; n is known at link.
/// >>> array(4, function(i) -> i * i)
/// [0, 1, 4, 9]
T[n] array(integer n, function(integer) -> generic T f) = intrinsic::array(n, f);

/// The array [f(a[0]), f(a[1]), ...]; of a matrix, f takes the rows.
/// >>> map(#sqrt, [1.0, 4.0])
/// [1, 2]
U[n] map(function(generic T) -> generic U f, T[n] a) = array(n, function(k) -> f(a[k]));

/// The array [f(a[0], b[0]), f(a[1], b[1]), ...].
/// >>> zip(#*, [1, 2], [3, 4])
/// [3, 8]
V[n] zip(function(generic T, generic U) -> generic V f, T[n] a, U[n] b) =
    array(n, function(k) -> f(a[k], b[k]));

/// f(... f(f(first, a[0]), a[1]) ..., a[n - 1]): `fold(#+, 0, a)` is the sum.
/// >>> fold(#+, 0, [1.5, 2.5])
/// 4
U fold(function(generic U, generic T) -> U f, U first, T[n] a)
    U upto(integer k, U so_far) = select
        so_far, if k == n;
        upto(k + 1, f(so_far, a[k])) otherwise
    end;
    return upto(0, first);

/// The exact derivative of f at x.
/// >>> gradient(function(x) -> x ^ 3, 2.0)
/// 12
real gradient(function(real) -> real f, real x) = intrinsic::gradient(f, x);

/// The exact partial derivatives of f at p.
/// >>> gradient(function(q) -> q.x ^ 2 * q.y, [2, 3])
/// [12, 4]
real[n] gradient(function(real[n]) -> real f, real[n] p) = intrinsic::gradient(f, p);

/// x limited to [0, 1].
/// >>> saturate(1.5)
/// 1
real saturate(real x) = clamp(x, 0.0, 1.0);

/// 0 where x is below `edge`, else 1.
/// >>> step(0.5, 0.7)
/// 1
real step(real edge, x) = select 0.0, if x < edge; 1.0 otherwise; end;

/// 1 from `a` (included) to `b` (not included), else 0.
/// >>> pulse(0.2, 0.4, 0.3)
/// 1
real pulse(real a, b, x) = step(a, x) - step(b, x);

/// 0 below `a`, 1 above `b`, a straight line between.
/// >>> linearstep(1.0, 3.0, 2.5)
/// 0.75
real linearstep(real a, b, x) = saturate((x - a) / (b - a));

/// 0 below `a`, 1 above `b`, between them the cubic that is level at both.
/// >>> smoothstep(0.0, 1.0, 0.25)
/// 0.15625
real smoothstep(real a, b, x)
    t = linearstep(a, b, x);
    return t * t * (3.0 - 2.0 * t);

/// The number that stands to [c, d] as x does to [a, b].
/// >>> remap(5.0, 0.0, 10.0, 1.0, 2.0)
/// 1.5
real remap(real x, a, b, c, d) = c + (x - a) * ((d - c) / (b - a));

/// Bends [0, 1] on itself so that 1/2 becomes `amount`, in (0, 1) (Schlick 1994).
/// >>> bias(0.5, 0.3)
/// 0.3
real bias(real x, amount) = x / ((1.0 / amount - 2.0) * (1.0 - x) + 1.0);

/// Steepens (`amount` above 1/2) or flattens the middle of [0, 1], which keeps 0, 1/2 and 1 (Schlick 1994).
/// >>> gain(0.5, 0.8)
/// 0.5
real gain(real x, amount) = select
    0.5 * bias(2.0 * x, 1.0 - amount), if x < 0.5;
    1.0 - 0.5 * bias(2.0 - 2.0 * x, 1.0 - amount) otherwise;
end;

/// a - b floor(a / b), as `a % b`: has the sign of b.
/// >>> mod(-1.0, 3.0)
/// 2
real mod(real a, b) = a % b;

/// How wide the pixel is, measured in `x`: the change of x across `$footprint`, exactly; at most
/// 1e6. Hand it as `width` to what can be filtered. Differentiation takes it for constant.
/// >>> filter_width($time)
/// 0
real filter_width(real x)
    width = intrinsic::across_footprint(x);
    return select width, if width < 1e6; 1e6 otherwise; end;

/// `filter_width` of each element.
/// >>> filter_width([1, 2])
/// [0, 0]
real[n] filter_width(real[n] p)
    width = intrinsic::across_footprint(p);
    return map(function(w) -> select w, if w < 1e6; 1e6 otherwise end, width);
