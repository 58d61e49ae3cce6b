// A value that does not widen to what is wanted.
integer a() = 3.7;
//            ^^^ error E0203: write `integer(...)`
real b() = true;
//         ^^^^ error E0203: expected `real`, found `logic`
real c() = spectrum(1);
//         ^^^^^^^^^^^ error E0203
const d = select 1, if 2; 3 otherwise end;
//                     ^ error E0203: a condition is `logic`
const real[2] v = [1, 2, 3];
//                ^^^^^^^^^ error E0203
const w = [1, true];
//            ^^^^ error E0203
surface s bsdf = rgb(1, 0, 0); end
//               ^^^^^^^^^^^^ error E0203: matte
const x = [1, 2][0.5];
//        ^^^^^^^^^^^ error E0203
