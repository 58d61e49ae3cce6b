// SPDX-License-Identifier: Apache-2.0
// Cellular noise in its general form: distances to the nearest three of random points, one in each
// unit cell, and to the border of the nearest one's cell, in 1 to 4 dimensions. Every seed has other
// points; `exponent` is that of Minkowski's distances, one of `manhattan`, `euclidean`, `chebyshev` or
// any other from 1 on; `jitter` 0 puts points in the middle of their cells, 1 anywhere in them; after
// `period`, which is rounded to whole cells, all repeats (0 is none).

/// The exponent of distances along the axes: |x| + |y| + ...
/// >>> minkowski([3, 4], manhattan)
/// 7
const real manhattan = 1.0;

/// The exponent of straight distances.
/// >>> minkowski([3, 4], euclidean)
/// 5
const real euclidean = 2.0;

/// The exponent of the largest distance along an axis.
/// >>> minkowski([3, 4], chebyshev)
/// 4
const real chebyshev = 1e9;

/// The length of `v` by Minkowski: the root of that exponent of the sum of such powers; the largest
/// |v[k]| for exponents above 64.
/// >>> minkowski([1, 2], 3.0)
/// 2.0800838...
/// >>> minkowski([0.001, 0.0], 60.0)
/// 0.001
real minkowski(real[n] v, real exponent)
    size    = map(#abs, v);
    largest = fold(#max, 0.0, size);
    // Powers soon leave the range of numbers, but not once the largest is divided out.
    powers  = map(function(x) -> min(x / largest, 1.0)^exponent, size);
    return select
        sqrt(fold(#+, 0.0, v * v)), if exponent == 2.0;
        fold(#+, 0.0, size), if exponent <= 1.0;
        largest, if exponent > 64.0 or largest == 0.0;
        largest * fold(#+, 0.0, powers)^(1.0 / exponent) otherwise;
    end;

/// Distances to the nearest three points: F1, F2 and F3.
/// >>> worley_distances([0.3, 0.7])[0] == worley_f1([0.3, 0.7])
/// true
real[3] worley_distances(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_nearest(p, seed, period, jitter, exponent);

/// The distance to the nearest point, F1.
/// >>> abs(worley_f1([0.3, 0.7]) - worley([0.3, 0.7])) < 1e-6
/// true
real worley_f1(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_distances(p, seed, exponent, jitter, period)[0];

/// The distance to the second nearest point, F2.
/// >>> worley_f2([0.3, 0.7], jitter = 0)
/// 0.82462...
real worley_f2(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_distances(p, seed, exponent, jitter, period)[1];

/// The distance to the third nearest point, F3.
/// >>> worley_f3([0.3, 0.7], 0, manhattan, 0.0)
/// 1
real worley_f3(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_distances(p, seed, exponent, jitter, period)[2];

/// F2 - F1: 0 on the borders between cells, growing towards the points.
/// >>> worley_gap([0.5, 0.75], jitter = 0)
/// 0.5
real worley_gap(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
)
    f = worley_distances(p, seed, exponent, jitter, period);
    return f[1] - f[0];

/// The squares of the distances F1, F2 and F3, which are smooth at the points.
/// >>> worley_squared([0.3, 0.7], jitter = 0)[0]
/// 0.08
real[3] worley_squared(
    real[n] p,
    integer seed = 0,
    real jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_nearest_squared(p, seed, period, jitter, 2.0);

/// How far the border of the nearest point's cell is, exactly: lines along it are of even width.
/// >>> worley_edge([0.7, 0.9], jitter = 0)
/// 0.1
real worley_edge(
    real[n] p,
    integer seed = 0,
    real jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_border_distance(p, seed, period, jitter);

/// A number in [0, 1) for each cell of the nearest points.
/// >>> worley_id([0.3, 0.7]) == worley_id([0.31, 0.69])
/// true
real worley_id(
    real[n] p,
    integer seed = 0,
    real exponent = 2.0,
    jitter = 1.0,
    real[n] period = array(n, function(k) -> 0.0)
) = worley_cell(p, seed, period, jitter, exponent);

/// F1 of that seed from -1 at the points to at most 1.
/// >>> worley_signed([0.5, 0.5], 3, 0.0)
/// -1
real worley_signed(real[n] p, integer seed = 0, real jitter = 1.0) =
    2.0 * worley_f1(p, seed, 2.0, jitter) / sqrt(n) - 1.0;
