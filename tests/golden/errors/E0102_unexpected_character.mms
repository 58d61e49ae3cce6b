// Signs that are not of the language.
const a = 1 − 2;
//          ^ error E0102
const b = 1 @ 2;
//          ^ error E0102
