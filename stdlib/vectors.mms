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

/// `cross` of complex vectors.
/// >>> cross([1i, 0, 0], [0, 1, 0])
/// [0, 0, 1i]
complex[3] cross(complex[3] a, b) = [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0]
];

/// `v` mirrored at the plane of unit normal `normal`.
/// >>> reflect([1, -1], [0, 1])
/// [1, 1]
real[n] reflect(real[n] v, normal) = v - (2.0 * dot(v, normal)) * normal;

/// Sum of the products of the components, the first conjugated: `dot(a, a)` is real.
/// >>> dot([1i, 2], [1i, 1])
/// 3 + 0i
complex dot(complex[n] a, b)
    complex sum(integer k, complex total) =
        select total, if k == n; sum(k + 1, total + conj(a[k]) * b[k]) otherwise; end;
    return sum(0, 0i);

/// Euclidean length.
/// >>> length([3i, 4])
/// 5
real length(complex[n] a) = sqrt(dot(a, a).re);

/// The vector of length 1 along `a`; 0 for the zero vector.
/// >>> normalize([3i, 4])
/// [0.6i, 0.8 + 0i]
complex[n] normalize(complex[n] a) = a / max(length(a), 1e-30);

/// `v`, or -v: whichever is on the side that `normal` points to.
/// >>> faceforward([1, -1], [0, 1])
/// [-1, 1]
real[n] faceforward(real[n] v, normal) = select -v, if dot(v, normal) < 0; v otherwise; end;

/// The direction into which the unit vector `v`, which goes towards a surface of unit normal
/// `normal`, is refracted; `ratio` is the refractive index it comes from over the one it goes to
/// (Snell's law). 0 where all is reflected.
/// >>> refract([0, -1], [0, 1], 0.7)
/// [0, -1]
/// >>> refract([0.8, -0.6], [0, 1], 1.5)
/// [0, 0]
real[n] refract(real[n] v, normal, real ratio)
    c = -dot(v, normal);
    k = 1.0 - ratio * ratio * (1.0 - c * c);
    return select
        0.0 * normal, if k < 0.0;
        ratio * v + (ratio * c - sqrt(max(k, 0.0))) * normal otherwise;
    end;

/// Rows become columns.
/// >>> transpose([1, 2; 3, 4; 5, 6])
/// [1, 3, 5, 2, 4, 6]
T[c, r] transpose(generic T[r, c] m) = array(c, function(i) -> array(r, function(j) -> m[j, i]));

/// The n x n matrix that changes nothing.
/// >>> identity(2)
/// [1, 0, 0, 1]
real[n, n] identity(integer n) =
    array(n, function(i) -> array(n, function(j) -> select 1.0, if i == j; 0.0 otherwise; end));

/// The product of two matrices, which `*` is not: that goes element by element.
/// >>> multiply([1, 2; 3, 4], [0, 1; 1, 0])
/// [2, 1, 4, 3]
T[r, c] multiply(generic T[r, m] a, T[m, c] b)
    T entry(integer i, j, k) =
        select a[i, 0] * b[0, j], if k == 0; entry(i, j, k - 1) + a[i, k] * b[k, j] otherwise; end;
    return array(r, function(i) -> array(c, function(j) -> entry(i, j, m - 1)));

/// The matrix `m` applied to the vector `v`.
/// >>> multiply([1, 2; 3, 4], [1, 1])
/// [3, 7]
T[r] multiply(generic T[r, c] m, T[c] v)
    T entry(integer i, k) =
        select m[i, 0] * v[0], if k == 0; entry(i, k - 1) + m[i, k] * v[k] otherwise; end;
    return array(r, function(i) -> entry(i, c - 1));

/// The matrix whose product with `m` is the determinant times the identity.
/// >>> adjugate([1, 2; 3, 4])
/// [4, -2, -3, 1]
T[2, 2] adjugate(generic T[2, 2] m) = [m[1, 1], -m[0, 1]; -m[1, 0], m[0, 0]];

/// Of three rows.
/// >>> adjugate([2, 0, 0; 0, 3, 0; 0, 0, 5])
/// [15, 0, 0, 0, 10, 0, 0, 0, 6]
T[3, 3] adjugate(generic T[3, 3] m)
    T of(integer i, j, k, l) = m[i, k] * m[j, l] - m[i, l] * m[j, k];
    return [
        [of(1, 2, 1, 2), of(0, 2, 2, 1), of(0, 1, 1, 2)],
        [of(1, 2, 2, 0), of(0, 2, 0, 2), of(0, 1, 2, 0)],
        [of(1, 2, 0, 1), of(0, 2, 1, 0), of(0, 1, 0, 1)]
    ];

/// Of four rows.
/// >>> adjugate([2, 0, 0, 0; 0, 3, 0, 0; 0, 0, 5, 0; 0, 0, 0, 1]) [0, 0]
/// 15
T[4, 4] adjugate(generic T[4, 4] m)
    T top(integer k, l) = m[0, k] * m[1, l] - m[0, l] * m[1, k];
    T low(integer k, l) = m[2, k] * m[3, l] - m[2, l] * m[3, k];
    T with_low(integer i, a, b, c) =
        m[i, a] * low(b, c) - m[i, b] * low(a, c) + m[i, c] * low(a, b);
    T with_top(integer i, a, b, c) =
        m[i, a] * top(b, c) - m[i, b] * top(a, c) + m[i, c] * top(a, b);
    return [
        [with_low(1, 1, 2, 3), -with_low(0, 1, 2, 3), with_top(3, 1, 2, 3), -with_top(2, 1, 2, 3)],
        [-with_low(1, 0, 2, 3), with_low(0, 0, 2, 3), -with_top(3, 0, 2, 3), with_top(2, 0, 2, 3)],
        [with_low(1, 0, 1, 3), -with_low(0, 0, 1, 3), with_top(3, 0, 1, 3), -with_top(2, 0, 1, 3)],
        [-with_low(1, 0, 1, 2), with_low(0, 0, 1, 2), -with_top(3, 0, 1, 2), with_top(2, 0, 1, 2)]
    ];

/// How much larger volumes become under `m`, of 2, 3 or 4 rows; negative where it mirrors.
/// >>> determinant([1, 2; 3, 4])
/// -2
/// >>> determinant([1i, 2; 3, 4])
/// -6 + 4i
T determinant(generic T[n, n] m)
    a = adjugate(m);
    T upto(integer k) =
        select m[0, 0] * a[0, 0], if k == 0; upto(k - 1) + m[0, k] * a[k, 0] otherwise; end;
    return upto(n - 1);

/// The matrix that undoes `m`, of 2, 3 or 4 rows (Cramer's rule); infinities and NaN where the
/// determinant is 0.
/// >>> inverse([1, 2; 3, 4])
/// [-2, 1, 1.5, -0.5]
real[n, n] inverse(real[n, n] m) = adjugate(m) / determinant(m);

/// The matrix that undoes `m`.
/// >>> multiply(inverse([1i, 0; 1, 2]), [1i, 2])
/// [1 + 0i, 0.5 + 0i]
complex[n, n] inverse(complex[n, n] m) = adjugate(m) / determinant(m);

/// The matrix that turns by `angle`, in radians, about `axis`, of any length but 0: against the clock
/// for who is looked at by the axis (Rodrigues).
/// >>> multiply(rotation([0, 0, 2], 90deg), [1, 0, 0])
/// [0, 1, 0]
real[3, 3] rotation(real[3] axis, real angle)
    a = normalize(axis);
    s = sin(angle);
    t = 2.0 * sin(0.5 * angle) * sin(0.5 * angle);
    c = 1.0 - t;
    return [
        [t * a.x * a.x + c, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y],
        [t * a.x * a.y + s * a.z, t * a.y * a.y + c, t * a.y * a.z - s * a.x],
        [t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c]
    ];

/// `p` turned by `angle`, in radians, about `axis` through the origin.
/// >>> rotate([1, 0, 0], [0, 1, 0], 90deg)
/// [0, 0, -1]
real[3] rotate(real[3] p, axis, real angle) = multiply(rotation(axis, angle), p);

/// The rotation into the frame of an eye at `from` that looks at `to`: rows are what is right of it,
/// above it, and behind it, each of length 1. `up` must not be along the view.
/// >>> multiply(look_at([0, 0, 0], [1, 0, 0], [0, 0, 1]), [5, 0, 2])
/// [0, 2, -5]
real[3, 3] look_at(real[3] from, to, up)
    back  = normalize(from - to);
    right = normalize(cross(up, back));
    return [right, cross(back, right), back];

/// [r, theta, phi] of a point: its distance, the angle from the third axis in [0, pi], and the angle
/// around it from the first, in [-pi, pi].
/// >>> spherical([0, 2, 0]) / [1, pi, pi]
/// [2, 0.5, 0.5]
real[3] spherical(real[3] p) = [length(p), atan2(hypot(p.x, p.y), p.z), atan2(p.y, p.x)];

/// The point of those spherical coordinates.
/// >>> from_spherical([2, 90deg, 90deg])
/// [0, 2, 0]
real[3] from_spherical(real[3] s) = [
    s[0] * sin(s[1]) * cos(s[2]),
    s[0] * sin(s[1]) * sin(s[2]),
    s[0] * cos(s[1])
];

/// [r, phi, z] of a point: its distance from the third axis, the angle around it from the first, in
/// [-pi, pi], and its height.
/// >>> cylindrical([0, 2, 5]) / [1, pi, 1]
/// [2, 0.5, 5]
real[3] cylindrical(real[3] p) = [hypot(p.x, p.y), atan2(p.y, p.x), p.z];

/// The point of those cylindrical coordinates.
/// >>> from_cylindrical([2, 90deg, 5])
/// [0, 2, 5]
real[3] from_cylindrical(real[3] c) = [c[0] * cos(c[1]), c[0] * sin(c[1]), c[2]];

/// How much each of the three axes faces along `normal`: shares that add up to 1. `sharpness`, at
/// least 1, narrows where one passes into another.
/// >>> triplanar_weights([0, 0, -1])
/// [0, 0, 1]
real[3] triplanar_weights(real[3] normal, real sharpness = 4.0)
    w = map(function(x) -> pow(abs(x), sharpness), normalize(normal));
    return w / (w.x + w.y + w.z);

/// A pattern of the plane, laid on all sides of a solid: `f` of the three projections of `p`, mixed by
/// how much `normal` faces each.
/// >>> triplanar(function(q) -> q.x, [1, 2, 3], [0, 1, 0])
/// 1
T triplanar(function(real[2]) -> generic T f, real[3] p, normal, real sharpness = 4.0)
    w = triplanar_weights(normal, sharpness);
    return w.x * f([p.y, p.z]) + w.y * f([p.x, p.z]) + w.z * f([p.x, p.y]);

/// Where a point of a box lies on that of the six sides that `normal` faces most.
/// >>> box_uv([1, 2, 3], [0, 0, -1])
/// [1, 2]
real[2] box_uv(real[3] p, normal)
    a = map(#abs, normal);
    return select
        [p.y, p.z], if a.x >= a.y and a.x >= a.z;
        [p.x, p.z], if a.y >= a.z;
        [p.x, p.y] otherwise;
    end;
