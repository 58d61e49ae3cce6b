// Over any spectrum, not only the wavelengths.
spectrum a() = spectral(function(x) -> x * x + 1, spectrum(3));                               // expect: 10
spectrum b() = spectral(function(x) -> select x, if x > 1; 0.0 otherwise end, spectrum(3));   // expect: 3
