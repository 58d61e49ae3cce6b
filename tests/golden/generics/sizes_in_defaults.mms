// A default may use the sizes and types that the formals bring.
integer count(real[n] p, integer k = n) = k;
T second(generic T[n] p, integer at = min(1, n - 1)) = p[at];
const a = count([1, 2, 3]);                     // expect: 3
const b = count([1, 2], 7);                     // expect: 7
const c = second([1i, 2i]);                     // expect: [0, 2]
const d = second([4.0]);                        // expect: 4
