// What a noise is good for (thesis, Figure 6.6). Each picture varies a number from left to right:
//
//     mms render --scene examples/figures/flat.json --surface octaves examples/figures/noise.mms
import "screen.mms";

real x() = $position.x;
real[2] p() = [8.0 * $position.x, 8.0 * $position.y];

/// Noise alone, finer and finer.
surface simple
    at       = [2.0 * exp2(3.0 * x), p[1]];
    bsdf     = matte(0.0);
    emission = screen_signed(perlin(at));
end

/// The sum of six octaves of it, each of which grows beside the one before.
surface octaves
    bsdf     = matte(0.0);
    emission = screen_signed(fbm(#perlin, p, 6, gain = mix(0.2, 0.8, x)));
end

/// Noise that bends the argument of a sine: bands become marble.
surface sine
    bsdf     = matte(0.0);
    emission = screen_signed(sin(6.0 * p[0] + 7.0 * x * fbm(#perlin, p, 6)));
end

/// Noise in an exponential: patches that stand apart, sharper and sharper.
surface exponential
    bsdf     = matte(0.0);
    emission = screen(exp(-mix(1.0, 40.0, x * x) * perlin(p)^2));
end
