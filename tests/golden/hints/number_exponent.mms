// An exponent has digits.
const a = 1e+;
//        ^^^ error E0110
