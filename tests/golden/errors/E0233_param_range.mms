// A param lies in its range.
param real s = 30.0 in [0.1, 20];
//             ^^^^ error E0233
