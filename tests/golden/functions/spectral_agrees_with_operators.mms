// At each wavelength what the operators over spectra give, whether the function works over spectra
// at once or wavelength by wavelength.
spectrum cauchy() = spectral(function(l) -> 1.5 + 4e-15 / (l * l)) - (1.5 + 4e-15 / ($wavelength * $wavelength));  // expect: 0
spectrum one_builtin() = spectral(#sqrt) - sqrt($wavelength);            // expect: 0
spectrum halves() = spectral(function(l) -> select l, if l < 600nm; l otherwise end) / $wavelength;   // expect: 1
spectrum of_time() = spectral(function(l) -> $time * l) - $time * $wavelength;    // expect: 0
