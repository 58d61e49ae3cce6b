// Elements are counted from 0.
const a = [1, 2, 3][3];
//        ^^^^^^^^^^^^ error E0210: index 3 is outside 0 .. 2
const b = [1, 2, 3][-1];
//        ^^^^^^^^^^^^^ error E0210
