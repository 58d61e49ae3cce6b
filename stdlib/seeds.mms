// SPDX-License-Identifier: Apache-2.0
// Noise in all its forms: with a seed, in [-1, 1], of several numbers, and sums of octaves that
// repeat. Every seed is another noise of the same kind; seed 0 is the one without seed.

/// `perlin` of that seed.
/// >>> perlin(0.3, 0) == perlin(0.3)
/// true
real perlin(real x, integer seed) = perlin(x, seed, 0.0);

/// `perlin` of that seed.
/// >>> perlin([0.3, 0.7], 0) == perlin([0.3, 0.7])
/// true
real perlin(real[n] p, integer seed) = perlin(p, seed, array(n, function(k) -> 0.0));

/// As many numbers in [-1, 1] as p has, of `perlin` with as many seeds from `seed` on.
/// >>> perlin_vector([0.3, 0.7], 4)[1] == perlin([0.3, 0.7], 5)
/// true
real[n] perlin_vector(real[n] p, integer seed = 0) =
    noise_vector(function(real[n] q, integer s) -> perlin(q, s), n, p, seed);

/// `valuenoise` of that seed.
/// >>> valuenoise(0.3, 0) == valuenoise(0.3)
/// true
real valuenoise(real x, integer seed) = valuenoise(x, seed, 0.0);

/// `valuenoise` of that seed.
/// >>> valuenoise([0.3, 0.7], 0) == valuenoise([0.3, 0.7])
/// true
real valuenoise(real[n] p, integer seed) = valuenoise(p, seed, array(n, function(k) -> 0.0));

/// As many numbers in [-1, 1] as p has, of `valuenoise` with as many seeds from `seed` on.
/// >>> valuenoise_vector([0.3, 0.7], 4)[1] == valuenoise([0.3, 0.7], 5)
/// true
real[n] valuenoise_vector(real[n] p, integer seed = 0) =
    noise_vector(function(real[n] q, integer s) -> valuenoise(q, s), n, p, seed);

/// Exact derivative of `valuenoise`.
/// >>> valuenoise_gradient(0.3) == valuenoise_gradient(0.3, 0, 0.0)
/// true
real valuenoise_gradient(real x) = valuenoise_gradient(x, 0, 0.0);

/// Exact gradient of `valuenoise`.
/// >>> valuenoise_gradient([0.3, 0.7]) == valuenoise_gradient([0.3, 0.7], 0, [0, 0])
/// true
real[n] valuenoise_gradient(real[n] p) = valuenoise_gradient(p, 0, array(n, function(k) -> 0.0));

/// `simplex` of that seed.
/// >>> simplex(0.3, 0) == simplex(0.3)
/// true
real simplex(real x, integer seed) = simplex(x, seed, 0.0);

/// `simplex` of that seed.
/// >>> simplex([0.3, 0.7], 0) == simplex([0.3, 0.7])
/// true
real simplex(real[n] p, integer seed) = simplex(p, seed, array(n, function(k) -> 0.0));

/// As many numbers in [-1, 1] as p has, of `simplex` with as many seeds from `seed` on.
/// >>> simplex_vector([0.3, 0.7], 4)[1] == simplex([0.3, 0.7], 5)
/// true
real[n] simplex_vector(real[n] p, integer seed = 0) =
    noise_vector(function(real[n] q, integer s) -> simplex(q, s), n, p, seed);

/// Exact derivative of `simplex`.
/// >>> simplex_gradient(0.3) == simplex_gradient(0.3, 0, 0.0)
/// true
real simplex_gradient(real x) = simplex_gradient(x, 0, 0.0);

/// Exact gradient of `simplex`.
/// >>> simplex_gradient([0.3, 0.7]) == simplex_gradient([0.3, 0.7], 0, [0, 0])
/// true
real[n] simplex_gradient(real[n] p) = simplex_gradient(p, 0, array(n, function(k) -> 0.0));

// Places of one coordinate may be written as arrays, so that what is said of any number of
// dimensions holds for one.

/// `perlin` of the only coordinate.
/// >>> perlin([0.3]) == perlin(0.3)
/// true
real perlin(real[1] p) = perlin(p[0]);

/// `perlin` of the only coordinate, with that seed and period.
/// >>> perlin([0.3], 7, [6]) == perlin(0.3, 7, 6)
/// true
real perlin(real[1] p, integer seed, real[1] period) = perlin(p[0], seed, period[0]);

/// `valuenoise` of the only coordinate.
/// >>> valuenoise([0.3]) == valuenoise(0.3)
/// true
real valuenoise(real[1] p) = valuenoise(p[0]);

/// `valuenoise` of the only coordinate, with that seed and period.
/// >>> valuenoise([0.3], 7, [6]) == valuenoise(0.3, 7, 6)
/// true
real valuenoise(real[1] p, integer seed, real[1] period) = valuenoise(p[0], seed, period[0]);

/// `simplex` of the only coordinate.
/// >>> simplex([0.3]) == simplex(0.3)
/// true
real simplex(real[1] p) = simplex(p[0]);

/// `simplex` of the only coordinate, with that seed and period.
/// >>> simplex([0.3], 7, [6]) == simplex(0.3, 7, 6)
/// true
real simplex(real[1] p, integer seed, real[1] period) = simplex(p[0], seed, period[0]);

/// `cellnoise` of the only coordinate.
/// >>> cellnoise([0.3]) == cellnoise(0.3)
/// true
real cellnoise(real[1] p) = cellnoise(p[0]);

/// `cellnoise` of the only coordinate, with that seed and period.
/// >>> cellnoise([0.3], 7, [6]) == cellnoise(0.3, 7, 6)
/// true
real cellnoise(real[1] p, integer seed, real[1] period) = cellnoise(p[0], seed, period[0]);

/// `hash` of the only coordinate and a seed.
/// >>> hash([0.3], 7) == hash(0.3, 7)
/// true
real hash(real[1] p, integer seed) = hash(p[0], seed);

/// `cellnoise` of that seed.
/// >>> cellnoise([0.3, 0.7], 0) == cellnoise([0.3, 0.7])
/// true
real cellnoise(real[n] p, integer seed) = cellnoise(p, seed, array(n, function(k) -> 0.0));

/// White noise in [-1, 1): another number for every argument and seed.
/// >>> white(0.3) == 2 * hash(0.3) - 1
/// true
real white(real x, integer seed = 0) = 2.0 * hash(x, seed) - 1.0;

/// White noise in [-1, 1): another number for every argument and seed.
/// >>> white([0.3, 0.7]) == 2 * hash([0.3, 0.7]) - 1
/// true
real white(real[n] p, integer seed = 0) = 2.0 * hash(p, seed) - 1.0;

/// A number in [-1, 1) for each unit cell and seed.
/// >>> blocks([0.3, 0.7]) == 2 * cellnoise([0.9, 0.1]) - 1
/// true
real blocks(real[n] p, integer seed = 0) =
    2.0 * cellnoise(p, seed, array(n, function(k) -> 0.0)) - 1.0;

/// `size` numbers from a noise: of as many seeds from `seed` on.
/// >>> noise_vector(function(real[2] q, integer s) -> q.x + s, 3, [0.5, 0.0], 1)
/// [1.5, 2.5, 3.5]
real[m] noise_vector(
    function(real[n], integer) -> real f,
    integer m,
    real[n] p,
    integer seed = 0
) = array(m, function(k) -> f(p, seed + k));

/// `fbm` that repeats along each axis after `period`: of a noise `f` of place, seed and period. Each
/// octave has twice the period and a seed of its own.
/// >>> fbm_tiled(#perlin, [0.25, 0.75], [4, 4], 3) == fbm_tiled(#perlin, [4.25, 0.75], [4, 4], 3)
/// true
real fbm_tiled(
    function(real[n], integer, real[n]) -> real f,
    real[n] p,
    period,
    real octaves,
    gain = 0.5,
    integer seed = 0
)
    real octave(real[n] q, size, real left, amplitude, integer s, real total) = select
        total, if left <= 0.0;
        octave(2.0 * q, 2.0 * size, left - 1.0, gain * amplitude, s + 1,
            total + amplitude * min(left, 1.0) * f(q, s, size)) otherwise;
    end;
    return octave(p, period, octaves, 1.0, seed, 0.0);
