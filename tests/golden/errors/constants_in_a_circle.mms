// Three constants that ask for one another: one message.
const a = b;
//    ^ error E0220
const b = 2 * c;
const c = a + 1;
const d = a;
