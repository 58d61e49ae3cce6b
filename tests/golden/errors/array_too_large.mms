// So do those of arrays of arrays.
row typeid real[100];
real f(row[41] v) = 1;
//     ^^^^^^^ error E0223: an array or structure of 4100 elements; there are 1 to 4096
