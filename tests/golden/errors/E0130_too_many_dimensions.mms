// Arrays have two dimensions at most.
real f(real[2, 3, 4] x) = 1;
//     ^^^^^^^^^^^^^ error E0130
