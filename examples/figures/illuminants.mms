// Thesis Figure 4.9: how many wavelengths a light takes. A black body of 2000 K above, D65 below, as
// flat patches: all that differs between pixels is chance. A sample is eight wavelengths that are spread
// evenly by their density, so that one is enough; single ones show what that spares.
//
//   mms render illuminants.mms --scene flat.json --filter box --samples 8 --sampler random --estimator single -o random.png
//   mms render illuminants.mms --scene flat.json --filter box --samples 1 --sampler random -o clusters.png

surface illuminants
    bsdf     = matte(0);
    emission = select
        blackbody_normalised(2000), if $uv.y > 0.5;
        0.6 * illuminant_d65($wavelength) otherwise;
    end;
end
