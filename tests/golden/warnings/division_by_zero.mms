// An integer quotient by a constant zero.
const a = 1 / 0;
//        ^^^^^ warning W0403
