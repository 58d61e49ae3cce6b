// Arrays have 1 to 4096 elements.
real[0] f() = [1];
//   ^ error E0223: 0
const n = 5000;
real[n] g() = [1];
//   ^ error E0223: 5000
