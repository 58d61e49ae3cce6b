// SPDX-License-Identifier: Apache-2.0
// Fractal sums of Perlin noise. The calls are in tail position, so octaves cost no stack.

/// Fractional Brownian motion: octaves of noise, each `gain` times as high and `lacunarity` times as fine as the one before.
/// Within (1 - gain^octaves) / (1 - gain) of 0.
/// >>> fbm([0.3, 0.7], 1) == perlin([0.3, 0.7])
/// true
real fbm(real[n] p, integer octaves, real gain = 0.5, lacunarity = 2.0)
    real octave(real[n] q, integer left, real amplitude, total)
        return select
            total, if left <= 0;
            octave(lacunarity * q, left - 1, gain * amplitude,
                total + amplitude * perlin(q)) otherwise;
        end;
    return octave(p, octaves, 1.0, 0.0);

/// As `fbm`, of the noise without its sign: billows that meet in creases. Never below 0.
/// >>> turbulence([0.3, 0.7], 1) == abs(perlin([0.3, 0.7]))
/// true
real turbulence(real[n] p, integer octaves, real gain = 0.5, lacunarity = 2.0)
    real octave(real[n] q, integer left, real amplitude, total)
        return select
            total, if left <= 0;
            octave(lacunarity * q, left - 1, gain * amplitude,
                total + amplitude * abs(perlin(q))) otherwise;
        end;
    return octave(p, octaves, 1.0, 0.0);

/// As `turbulence`, upside down: sharp ridges of height 1 an octave. Never below 0.
/// >>> ridged([2, 3], 2)
/// 1.5
real ridged(real[n] p, integer octaves, real gain = 0.5, lacunarity = 2.0)
    real octave(real[n] q, integer left, real amplitude, total)
        return select
            total, if left <= 0;
            octave(lacunarity * q, left - 1, gain * amplitude,
                total + amplitude * (1.0 - abs(perlin(q)))) otherwise;
        end;
    return octave(p, octaves, 1.0, 0.0);
