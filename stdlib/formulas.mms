// SPDX-License-Identifier: Apache-2.0
// Functions of the library written in the language itself, where their derivative is taken from.

/// What `sellmeier` computes.
/// >>> sellmeier_formula(550e-9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
/// 1
real sellmeier_formula(real wavelength, b1, c1, b2, c2, b3, c3)
    um = wavelength * 1e6;
    l2 = um * um;
    n2 = 1.0 + b1 * l2 / (l2 - c1) + b2 * l2 / (l2 - c2) + b3 * l2 / (l2 - c3);
    return select sqrt(n2), if n2 > 0.0; 1.0 otherwise; end;

/// What `fresnel` computes.
/// >>> abs(fresnel_formula(1.0, 1.5) - 0.04) < 1e-6
/// true
real fresnel_formula(real cos_theta, ior)
    c  = min(abs(cos_theta), 1.0);
    e  = (ior - 1.0) * (ior + 1.0);
    g2 = c * c + e;
    g  = sqrt(g2);
    s  = c + g;
    p  = ior * ior * c + g;
    rs = e / (s * s);
    rp = e * ((ior * ior + 1.0) * c * c - 1.0) / (p * p);
    return select 1.0, if g2 <= 0.0; 0.5 * (rs * rs + rp * rp) otherwise; end;

/// What `fresnel_conductor` computes.
/// >>> abs(fresnel_conductor_formula(1.0, 1.0, 2.0) - 0.5) < 1e-6
/// true
real fresnel_conductor_formula(real cos_theta, n, k)
    c          = min(abs(cos_theta), 1.0);
    s2         = (1.0 - c) * (1.0 + c);
    t          = (n - k) * (n + k) - s2;
    nk         = n * k;
    q          = sqrt(t * t + 4.0 * nk * nk);
    a          = select sqrt(0.5 * (q + t)), if t >= 0.0; nk / sqrt(0.5 * (q - t)) otherwise; end;
    ac         = a * c;
    m          = n * n + k * k;
    p          = ac * (q + s2);
    absorbed_s = 4.0 * ac / (q + c * c + 2.0 * ac);
    absorbed_p = 4.0 * p / (c * c * m * m + 2.0 * p + q);
    return 1.0 - 0.5 * (absorbed_s + absorbed_p);

/// What `worley_nearest` computes.
/// >>> worley_nearest_formula([0.3, 0.7], 7, [0, 0], 0.0, 2.0)[1]
/// 0.82462...
real[3] worley_nearest_formula(real[n] p, integer seed, real[n] period, real jitter, exponent)
    ways = worley_ways(p, seed, period, jitter, exponent);
    return array(3, function(j) -> minkowski(array(n, function(k) -> ways[j * n + k]), exponent));

/// What `worley_nearest_squared` computes.
/// >>> worley_nearest_squared_formula([0.3, 0.7], 7, [0, 0], 0.0, 2.0)[0]
/// 0.08
real[3] worley_nearest_squared_formula(
    real[n] p,
    integer seed,
    real[n] period,
    real jitter,
    exponent
)
    ways = worley_ways(p, seed, period, jitter, exponent);
    return array(3,
        function(j) -> fold(#+, 0.0, array(n, function(k) -> ways[j * n + k] * ways[j * n + k])));

/// What `worley_border_distance` computes.
/// >>> worley_border_distance_formula([0.7, 0.9], 7, [0, 0], 0.0)
/// 0.1
real worley_border_distance_formula(real[n] p, integer seed, real[n] period, real jitter)
    ways = worley_border(p, seed, period, jitter);
    a    = array(n, function(k) -> ways[k]);
    b    = array(n, function(k) -> ways[n + k]);
    step = b - a;
    size = max(sqrt(fold(#+, 0.0, step * step)), 1e-6);
    return max(0.5 * fold(#+, 0.0, (b + a) * step) / size, 0.0);
