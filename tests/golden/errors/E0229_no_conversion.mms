// What converts to what.
const a = integer([1, 2]);
//        ^^^^^^^^^^^^^^^ error E0229
const b = real(spectrum(1));
//        ^^^^^^^^^^^^^^^^^ error E0229
const c = logic(1);
//        ^^^^^^^^ error E0229
