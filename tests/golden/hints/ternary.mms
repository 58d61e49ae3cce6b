// ? : is select.
const a = 1 < 2 ? 3 : 4;
//              ^ error E0143: select
