// A recursive function may take and give arrays.
real[2] spin(real[2] p, integer n) = select p, if n == 0; spin([-p.y, p.x], n - 1) otherwise end;
real[2] a() = spin([1, 2], integer(3 * $position.z));     // expect: [2, -1]
const b = spin([1, 2], 6);                                // expect: [-1, -2]
