// From the left; the type of what is carried along joins the first value and the results.
const a = fold(#+, 0, [1, 2, 3]);                                   // expect: 6
const b = fold(#+, 0, [1.5, 2.5]);                                  // expect: 4
const c = fold(#-, 10, [1, 2, 3]);                                  // expect: 4
const d = fold(#max, -1, [3, 7, 5]);                                // expect: 7
const k = fold(function(so_far, x) -> so_far and x > 0, true, [1, 2]);   // expect: true
const m = fold(function(s, row) -> s + row, [0, 0], [1, 2; 3, 4]);  // expect: [4, 6]
const n = fold(function(s, z) -> s * z, 1, [1i, 1i]);               // expect: [-1, 0]
real at_hit() = fold(#+, 0, [$time, -$time]);                       // expect: 0
