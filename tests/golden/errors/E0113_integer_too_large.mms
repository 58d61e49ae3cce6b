// An integer has 32 bits; only below a minus may it be 2^31.
const a = 3000000000;
//        ^^^^^^^^^^ error E0113: 3000000000.0
const b = -2147483648;
const c = 2147483648;
//        ^^^^^^^^^^ error E0113
