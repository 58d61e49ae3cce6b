// SPDX-License-Identifier: Apache-2.0
// Sums, products and distortions of octaves of any noise. The calls are in tail position, so octaves
// cost no stack. Octaves may be a fraction: the last one then counts as much, so that nothing pops
// as the number grows. `width` is `filter_width(p)`: an octave that is too fine for the pixel fades
// to its mean.

/// How much is left of detail of size 1 in a pixel `width` wide: 1 up to 1/4, 0 from 3/4 on, where
/// one sample a pixel would alias.
/// >>> fade(0.5)
/// 0.5
real fade(real width) = 1.0 - smoothstep(0.25, 0.75, width);

/// The largest of the numbers; 0 if all are below.
/// >>> widest([0.1, 0.3, 0.2])
/// 0.3
real widest(real[n] width)
    real upto(integer k, real so_far) =
        select so_far, if k == n; upto(k + 1, max(so_far, width[k])) otherwise; end;
    return upto(0, 0.0);

/// f(p) + gain f(lacunarity p) + ...: as many octaves of `f`, each `gain` times as high and
/// `lacunarity` times as fine as the one before. `mean` is the mean of f, which stays of an octave
/// that is too fine for the pixel.
/// >>> octave_sum(function(q) -> 1.0, [1, 2], 2.5)
/// 1.625
real octave_sum(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0),
    real mean = 0.0
)
    real sharp(real[n] q, real left, amplitude, total) = select
        total, if left <= 0.0;
        sharp(lacunarity * q, left - 1.0, gain * amplitude,
            total + amplitude * min(left, 1.0) * f(q)) otherwise;
    end;
    real seen(real[n] q, real size) = select
        mean, if size >= 0.75;
        mean + fade(size) * (f(q) - mean) otherwise;
    end;
    real faded(real[n] q, real left, amplitude, size, total) = select
        total, if left <= 0.0;
        faded(lacunarity * q, left - 1.0, gain * amplitude, lacunarity * size,
            total + amplitude * min(left, 1.0) * seen(q, size)) otherwise;
    end;
    size = widest(width);
    return select
        sharp(p, octaves, 1.0, 0.0), if size <= 0.0;
        faded(p, octaves, 1.0, size, 0.0) otherwise;
    end;

/// Fractional Brownian motion of any noise `f` of mean 0: `octave_sum`, within
/// (1 - gain^octaves) / (1 - gain) of 0 if f is in [-1, 1].
/// >>> fbm(#perlin, [0.3, 0.7], 1) == perlin([0.3, 0.7])
/// true
real fbm(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
) = octave_sum(f, p, octaves, gain, lacunarity, width);

/// `fbm` of Perlin noise.
/// >>> fbm([0.3, 0.7], 1) == perlin([0.3, 0.7])
/// true
real fbm(
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
) = octave_sum(#perlin, p, octaves, gain, lacunarity, width);

/// As `fbm`, of the noise without its sign: billows that meet in creases. Never below 0. `mean` is
/// the mean of |f|: that of Perlin noise is 0.27 in the plane and 0.21 in space.
/// >>> turbulence(#perlin, [0.3, 0.7], 1) == abs(perlin([0.3, 0.7]))
/// true
real turbulence(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0),
    real mean = 0.24
) = octave_sum(function(q) -> abs(f(q)), p, octaves, gain, lacunarity, width, mean);

/// `turbulence` of Perlin noise.
/// >>> turbulence([0.3, 0.7], 1) == abs(perlin([0.3, 0.7]))
/// true
real turbulence(
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
) = turbulence(#perlin, p, octaves, gain, lacunarity, width);

/// As `turbulence`, upside down: sharp ridges of height 1 an octave. Never below 0 if f is in [-1, 1].
/// >>> ridged(#perlin, [2, 3], 2)
/// 1.5
real ridged(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0),
    real mean = 0.24
) = octave_sum(function(q) -> 1.0 - abs(f(q)), p, octaves, gain, lacunarity, width, 1.0 - mean);

/// `ridged` of Perlin noise.
/// >>> ridged([2, 3], 2)
/// 1.5
real ridged(
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
) = ridged(#perlin, p, octaves, gain, lacunarity, width);

/// A product of octaves, (1 + f(p)) (1 + gain f(lacunarity p)) ...: rough where it is high, smooth
/// where it is low (Musgrave 1994). Never below 0 if f is in [-1, 1] and gain in [0, 1].
/// >>> multifractal(function(q) -> 0.5, [1, 2], 2)
/// 1.875
real multifractal(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
)
    real octave(real[n] q, real left, amplitude, size, total) = select
        total, if left <= 0.0 or size >= 0.75;
        octave(lacunarity * q, left - 1.0, gain * amplitude, lacunarity * size,
            total * (1.0 + amplitude * min(left, 1.0) * fade(size) * f(q))) otherwise;
    end;
    return octave(p, octaves, 1.0, widest(width), 1.0);

/// Terrain that is smooth near height 0, its sea level, and rougher the higher it is (Musgrave 1994):
/// each octave is weighted by the height so far. `offset` lifts all of it.
/// >>> hetero_terrain(function(q) -> 0.5, [1, 2], 2)
/// 2.625
real hetero_terrain(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    offset = 1.0,
    real[n] width = array(n, function(k) -> 0.0)
)
    real seen(real[n] q, real size) = offset + fade(size) * f(q);
    real octave(real[n] q, real left, amplitude, size, total) = select
        total, if left <= 0.0;
        octave(lacunarity * q, left - 1.0, gain * amplitude, lacunarity * size,
            total + amplitude * min(left, 1.0) * seen(q, size) * total) otherwise;
    end;
    size = widest(width);
    return octave(lacunarity * p, octaves - 1.0, gain, lacunarity * size, seen(p, size));

/// Ridges that carry finer ridges, with smooth valleys between (Musgrave 1994): each octave is
/// (1 - |f|)^2, weighted by `sharpness` times the one before, at most 1. In
/// [0, (1 - gain^octaves) / (1 - gain)] if f is in [-1, 1]. `mean` is the mean of |f|.
/// >>> ridged_multifractal(function(q) -> 0.5, [1, 2], 2)
/// 0.3125
real ridged_multifractal(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    gain = 0.5,
    lacunarity = 2.0,
    sharpness = 2.0,
    real[n] width = array(n, function(k) -> 0.0),
    real mean = 0.24
)
    real octave(real[n] q, real left, amplitude, size, weight, total)
        ridge  = 1.0 - mix(mean, abs(f(q)), fade(size));
        signal = ridge * ridge * weight;
        return select
            total, if left <= 0.0;
            octave(lacunarity * q, left - 1.0, gain * amplitude, lacunarity * size,
                saturate(sharpness * signal),
                total + amplitude * min(left, 1.0) * signal) otherwise;
        end;
    return octave(p, octaves, 1.0, widest(width), 1.0, 0.0);

/// `p`, moved along each axis by `amount` times a noise `f` of its own.
/// >>> warp(function(q) -> 0.5, [1, 2], 0.2)
/// [1.1, 2.1]
real[n] warp(function(real[n]) -> real f, real[n] p, real amount) =
    p + amount * array(n, function(k) -> f(p + 17.3 * k));

/// `f` at points that `f` itself has moved by up to `amount`, as often as `times` says: folds and
/// swirls.
/// >>> domain_warp(#perlin, [0.3, 0.7], 0.0) == perlin([0.3, 0.7])
/// true
real domain_warp(function(real[n]) -> real f, real[n] p, real amount, integer times = 1)
    real again(integer left, real[n] moved) =
        select f(moved), if left <= 0; again(left - 1, warp(f, moved, amount)) otherwise; end;
    return again(times, p);

/// The flow of an incompressible fluid in the plane: `f`'s gradient, turned by a right angle. Its
/// divergence is 0 exactly (Bridson 2007).
/// >>> curl(function(q) -> q.x * q.y, [2, 3])
/// [2, -3]
real[2] curl(function(real[2]) -> real f, real[2] p)
    g = gradient(f, p);
    return [g[1], -g[0]];

/// The flow of an incompressible fluid in space: the curl of a potential whose three components are
/// `f` at three places far from one another (Bridson 2007).
/// >>> curl(function(q) -> 1.0, [1, 2, 3])
/// [0, 0, 0]
real[3] curl(function(real[3]) -> real f, real[3] p)
    a = gradient(f, p);
    b = gradient(f, p + [31.4, 17.9, -12.3]);
    c = gradient(f, p + [-21.7, 41.1, 27.5]);
    return [c[1] - b[2], a[2] - c[0], b[0] - a[1]];

/// `fbm` whose finer octaves are carried down the slopes of the coarser ones by `pull` of their own
/// size (pseudo-advection, Perlin and Neyret 2001): smoke and flowing lava. A `height` made of it
/// wants its `gradient` stated.
/// >>> flow(#perlin, [0.3, 0.7], 1) == perlin([0.3, 0.7])
/// true
real flow(
    function(real[n]) -> real f,
    real[n] p,
    real octaves,
    pull = 0.3,
    gain = 0.5,
    lacunarity = 2.0,
    real[n] width = array(n, function(k) -> 0.0)
)
    real octave(real[n] q, real left, amplitude, size, total) = select
        total, if left <= 0.0 or size >= 0.75;
        octave(lacunarity * (q - pull * gradient(f, q)), left - 1.0, gain * amplitude,
            lacunarity * size, total + amplitude * min(left, 1.0) * fade(size) * f(q)) otherwise;
    end;
    return octave(p, octaves, 1.0, widest(width), 0.0);
