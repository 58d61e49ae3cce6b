// Nor equality.
logic a() = $wavelength < 1;
//          ^^^^^^^^^^^^^^^ error E0206
logic b() = $wavelength == $wavelength;
//          ^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0206
