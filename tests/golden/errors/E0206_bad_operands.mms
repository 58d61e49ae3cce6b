// What operators do not combine.
const a = 1 + true;
//        ^^^^^^^^ error E0206
const b = [1, 2] + [1, 2, 3];
//        ^^^^^^^^^^^^^^^^^^ error E0206: their sizes must agree
const c = spectrum(1) < 2;
//        ^^^^^^^^^^^^^^^ error E0206
const d = 1i < 2;
//        ^^^^^^ error E0206
const g = "a" + "b";
//        ^^^^^^^^^ error E0206
const h = 1 and true;
//        ^^^^^^^^^^ error E0206
const i = #sin + 1;
//        ^^^^^^^^ error E0206: call the function first
surface s bsdf = matte(1) - matte(1); end
//               ^^^^^^^^^^^^^^^^^^^ error E0206
const j = 1i + spectrum(1);
//        ^^^^^^^^^^^^^^^^ error E0206
const k = spectrum(1) % 2;
//        ^^^^^^^^^^^^^^^ error E0206
