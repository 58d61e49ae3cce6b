// Polished marble: dark veins where a ridged fractal peaks, under a clear gloss.
import "noise" as n;

param real scale = 1.6 in [0.1, 20], label = "Scale";
param integer octaves = 6, label = "Octaves";

surface marble
    p     = scale * $object_position;
    bend  = [n::perlin(p), n::perlin(p + [5.2, 1.3, 8.1]), n::perlin(p - [3.7, 9.2, 2.6])];
    t     = n::ridged(p + 0.7 * bend, octaves) / 2;
    veins = mix(rgb(0.86, 0.84, 0.79), rgb(0.09, 0.10, 0.15), smoothstep(0.68, 0.93, t));
    bsdf  = fresnel_mix(matte(veins), glossy(colour = 1, gloss = 900.0), ior = 1.5);
end
