// Only formals leave sizes open.
real[] f() = [1, 2];
//   ^ error E0222
