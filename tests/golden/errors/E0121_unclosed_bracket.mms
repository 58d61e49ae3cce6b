// A bracket is closed where what it holds ends.
const a = (1 + 2;
//              ^ error E0121: opened here
const b = [1, 2);
//             ^ error E0121
