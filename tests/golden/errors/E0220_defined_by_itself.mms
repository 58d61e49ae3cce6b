// Constants that ask for each other: said once.
const a = b + 1;
//    ^ error E0220
const b = a + 1;
const c = a + b;
