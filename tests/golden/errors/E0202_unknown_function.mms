// A function that is not there.
real f() = sine(2.0);
//         ^^^^ error E0202
const a = #nothing_here;
//         ^^^^^^^^^^^^ error E0202
