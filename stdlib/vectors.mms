// SPDX-License-Identifier: Apache-2.0
// Vectors of any dimension, as real[n].

/// Sum of the products of the components.
/// >>> dot([1, 2, 3], [4, 5, 6])
/// 32
real dot(real[n] a, b)
    real sum(integer k, real total)
        return select
            total, if k == n;
            sum(k + 1, total + a[k] * b[k]) otherwise;
        end;
    return sum(0, 0.0);

/// Euclidean length.
/// >>> length([3, 4])
/// 5
real length(real[n] a) = sqrt(dot(a, a));

/// Distance of two points.
/// >>> distance([1, 1], [4, 5])
/// 5
real distance(real[n] a, b) = length(b - a);

/// The vector of length 1 along `a`; 0 for the zero vector.
/// >>> normalize([0, 3, 4])
/// [0, 0.6, 0.8]
real[n] normalize(real[n] a) = a / max(length(a), 1e-30);

/// The vector at a right angle to both, as long as the parallelogram they span is large.
/// >>> cross([1, 0, 0], [0, 1, 0])
/// [0, 0, 1]
real[3] cross(real[3] a, b) = [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0]
];

/// `v` mirrored at the plane of unit normal `normal`.
/// >>> reflect([1, -1], [0, 1])
/// [1, 1]
real[n] reflect(real[n] v, normal) = v - (2.0 * dot(v, normal)) * normal;
