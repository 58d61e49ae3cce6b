// Names that are kept for later.
spectrum f() = spectral(#sin);
//             ^^^^^^^^^^^^^^ error E0312: `spectral`
real[2] g() = gradient(#sin, 1);
//            ^^^^^^^^^^^^^^^^^ error E0312: `gradient`
