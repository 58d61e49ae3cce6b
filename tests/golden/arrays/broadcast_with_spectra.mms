// An array of spectra.
spectrum[2] a() = [rgb(1, 1, 1), 0.5];      // expect: [1, 0.5]
spectrum b() = a[0] - a[1];                 // expect: 0.5
