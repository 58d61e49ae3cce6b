// Metals and glasses of the library.
surface s bsdf = gold(0.2); end
surface t bsdf = glass(); end
surface u bsdf = glass(bk7()); end
// expect-info: surface s bsdf = varying spectral reads $wavelength
// expect-output: surface t bsdf = dielectric(1.5, 0, 1, 1, 0)
// expect-info: surface t bsdf = constant
// expect-info: surface u bsdf = varying spectral reads $wavelength
