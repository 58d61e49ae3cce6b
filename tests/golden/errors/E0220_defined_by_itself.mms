// A constant that asks for itself.
const a = b + 1;
//    ^ error E0220
const b = a + 1;
//    ^ error E0220
