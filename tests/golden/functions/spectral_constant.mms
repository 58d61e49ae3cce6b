// A function of the wavelength that does not look at it.
spectrum flat() = spectral(function(l) -> 0.25);                         // expect: 0.25
spectrum select_away() = spectral(function(l) -> select 2.0, if l > 0; l otherwise end);   // expect: 2
