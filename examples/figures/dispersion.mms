// Thesis Figure 4.6: a prism's rainbow by the full spectrum, and by three wavelengths, as a renderer
// of red, green and blue has it: three bands. 645, 526 and 444 nm stand for the thirds around them.
//
//   mms render dispersion.mms --scene prism --surface full -o full.png
//   mms render dispersion.mms --scene prism --surface three -o three.png

/// The index of dense flint (thesis Figure 4.6 has a stronger one, made up).
/// >>> glass(444nm) > glass(645nm)
/// true
T glass(generic T wavelength) = 1.68 + 1.6e-14 / wavelength^2;

surface full
    bsdf = dielectric(glass($wavelength));
end

surface three
    red  = min(max(($wavelength - 584nm) / 2nm, 0), 1);
    blue = min(max((486nm - $wavelength) / 2nm, 0), 1);
    bsdf = dielectric(glass(645nm) * red + glass(444nm) * blue + glass(526nm) * (1 - red - blue));
end
