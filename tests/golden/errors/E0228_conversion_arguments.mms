// A conversion takes one value.
const a = real(1, 2);
//        ^^^^^^^^^^ error E0228
const b = integer();
//        ^^^^^^^^^ error E0228
