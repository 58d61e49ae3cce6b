// A library function of reals takes spectra, wavelength by wavelength.
spectrum a() = sin($wavelength / $wavelength);              // expect: 0.8414709848078965
spectrum b() = pow(spectrum(2), 3);                         // expect: 8
spectrum c() = clamp(2 * spectrum($position.z), 0, 1);      // expect: 1
spectrum d() = atan2(1.0, spectrum(1));                     // expect: 0.7853981633974483
