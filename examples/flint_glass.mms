// A ball of heavy flint glass. The index falls with wavelength, so every edge is a small rainbow.
// Cauchy's formula: n = a + b / wavelength^2, wavelengths in metres.
param real dispersion = 1.0 in [0, 5], label = "Dispersion";

surface flint_glass
    ior  = 1.72 + dispersion * 0.022e-12 / ($wavelength * $wavelength);
    bsdf = dielectric(ior);
end
