// Spectra combine at each wavelength; $wavelength is the spectrum of wavelengths in metres.
const a = spectrum(0.5) * 2;     // expect: 1
spectrum b() = $wavelength / 1nm;               // expect~1e-6: [400, 450, 500, 550, 600, 650, 700, 750]
spectrum d() = -spectrum(0.5) + 1;              // expect: 0.5
spectrum e1() = sqrt($wavelength / 100nm);      // expect~1e-6: [2, 2.1213203435596424, 2.23606797749979, 2.345207879911715, 2.449489742783178, 2.5495097567963922, 2.6457513110645907, 2.738612787525831]
spectrum f() = max($wavelength, 600nm) / 600nm; // expect~1e-6: [1, 1, 1, 1, 1, 1.0833333333333333, 1.1666666666666667, 1.25]
spectrum g() = 2 ^ spectrum(3);                 // expect~1e-6: 8
spectrum h() = spectrum(3) ^ 2;                 // expect: 9
