// Types and name spaces are no values.
import "noise" as n;
point typeid real[3];
const a = point;
//        ^^^^^ error E0218
const b = n;
//        ^ error E0218
