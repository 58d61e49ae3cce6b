// A type has no value.
const a = real;
//        ^^^^ error E0151
