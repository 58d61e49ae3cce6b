// SPDX-License-Identifier: Apache-2.0
// Gabor noise (sparse convolution, Lewis 1989, Lagae et al. 2009): one wave packet in each unit cell, at
// a random place and phase, so that the noise has little but the frequency that is asked for.

/// x near 0, never beyond -1 and 1: x / (1 + x^4)^(1/4).
/// >>> limited(0.1)
/// 0.0999975
real limited(real x)
    square = x * x;
    return clamp(x / sqrt(sqrt(1.0 + square * square)), -1.0, 1.0);

/// What is left of a wave in the mean over a pixel that is that many waves wide: sin(pi x) / (pi x); 0
/// from 1 on.
/// >>> box_response(0.5)
/// 0.636619772
real box_response(real waves)
    x = pi * abs(waves);
    return select
        1.0 - x * x / 6.0, if x < 1e-3;
        sin(x) / x, if x < pi;
        0.0 otherwise;
    end;

/// The sum of wave packets (1 - d^2)^3 cos(2 pi (f.d + phase)) at random places, one a cell, times
/// what makes its root mean square 0.3. `wave` gives f of a packet from a number in [0, 1) that the
/// packet has alone.
/// >>> abs(gabor_sum(function(id) -> [4, 0], [0.3, 0.7], 0, [0, 0])) < 2
/// true
real gabor_sum(function(real) -> real[n] wave, real[n] p, integer seed, real[n] period)
    corner = map(#floor, p);
    real packet(integer c)
        cell = array(n, function(k) -> floor(c / 3.0^k) % 3.0 - 0.5);
        id   = cellnoise(corner + cell, seed, period);
        d    = array(n, function(k) -> p[k] - corner[k] - cell[k] + 0.5 - hash(id, k));
        fade = max(1.0 - dot(d, d), 0.0);
        return fade * fade * fade * cos(tau * (dot(wave(id), d) + hash(id, n)));
    real upto(integer c, real total) =
        select total, if c < 0; upto(c - 1, total + packet(c)) otherwise; end;
    scale = [0.51375, 0.6333, 0.79378, 1.01061];  // 0.3 sqrt(2 / integral of the packet's square)
    return scale[n - 1] * upto(integer(3.0^n + 0.5) - 1, 0.0);

/// Gabor noise of waves along `frequency`, in cycles a unit; in [-1, 1], its root mean square 0.3 and its
/// bandwidth 0.4. `width`, which is `filter_width(p)`, filters it: each packet is replaced by its mean
/// over the pixel, which is nearly another packet, weaker and slower.
/// >>> abs(gabor([0.3, 0.7], [4, 0])) < 1
/// true
/// >>> abs(gabor([0.3, 0.7], [4, 0], 0, [0.5, 0.5])) < 0.01
/// true
real gabor(
    real[n] p,
    frequency,
    integer seed = 0,
    real[n] width = array(n, function(k) -> 0.0),
    period = array(n, function(k) -> 0.0)
)
    slower = map(function(w) -> 1.0 / (1.0 + 0.5 * w * w), width);
    weaker = array(n, function(k) ->
        box_response(width[k] * frequency[k] * sqrt(slower[k])) * sqrt(slower[k]));
    return limited(fold(#*, 1.0, weaker)
        * gabor_sum(function(id) -> frequency * slower, p, seed, period));

/// Gabor noise of waves in every direction, with that many cycles a unit; in [-1, 1], its root mean
/// square 0.3. `width`: as for `gabor`, taken for the same along every axis.
/// >>> abs(gabor_isotropic([0.3, 0.7], 4.0)) < 1
/// true
real gabor_isotropic(
    real[n] p,
    real frequency = 2.0,
    integer seed = 0,
    real[n] width = array(n, function(k) -> 0.0),
    period = array(n, function(k) -> 0.0)
)
    size   = widest(width);
    slower = 1.0 / (1.0 + 0.5 * size * size);
    weaker = box_response(size * frequency * sqrt(slower)) * slower^(0.5 * n);
    // Three uniform numbers add up to nearly a normal one, and normal ones point anywhere.
    real[n] wave(real id)
        v = array(n, function(k) ->
            hash(id, 3 * k + 16) + hash(id, 3 * k + 17) + hash(id, 3 * k + 18) - 1.5);
        return (frequency * slower / sqrt(max(dot(v, v), 1e-12))) * v;
    return limited(weaker * gabor_sum(#wave, p, seed, period));
