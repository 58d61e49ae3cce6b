// Thesis Figure 4.11: what a cluster of wavelengths is worth as scattering gets glossier and depends
// more on wavelength, from frosted glass of one index to a clear one that disperses: at the end a
// path serves one wavelength only. Four clusters a pixel, as there.
//
//   mms render frosted.mms --scene frosted.json --samples 4 --sweep step=0:1:5 --size 160x160 -o frosted.png

param real step = 0.5 in [0, 1], label = "From one index, rough, to dispersing and clear";

surface frosted
    spread = 0.3 * step;
    ior    = 1.2 + spread * (830nm - $wavelength) / 470nm;
    bsdf   = dielectric(ior, roughness = 0.35 * (1 - step)^2);
end
