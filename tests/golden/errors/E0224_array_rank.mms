// Two dimensions at most, in values too.
const m = [1, 2; 3, 4];
const a = [m, m];
//        ^^^^^^ error E0224
