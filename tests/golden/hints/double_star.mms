// A power is `^`.
const a = 2 ** 3;
//          ^^ error E0141: write `^`
