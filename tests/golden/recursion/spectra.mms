// A machine function over spectra.
spectrum layers(spectrum s, integer n) = select s, if n == 0; layers(0.5 * s + 0.25, n - 1) otherwise end;
spectrum a() = layers(spectrum(1), integer(2 * $position.z));                // expect: 0.625
