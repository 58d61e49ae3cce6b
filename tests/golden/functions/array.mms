// An array by a function of the index.
const a = array(4, function(i) -> i * i);                          // expect: [0, 1, 4, 9]
param integer count = 3;
const b = array(count, function(i) -> 1 / (i + 1));                // expect: [1, 0.5, 0.3333333333333333]
const c = array(2, function(i) -> array(2, function(j) -> 10 * i + j));   // expect: [0, 1, 10, 11]
real total(real[n] v) = fold(#+, 0, v);
const d = total(array(100, function(i) -> i));                     // expect: 4950
const k = map(function(real i) -> [#sin, #cos][1](i), [0.0])[0];    // expect: 1
