// Each operator as a value; the expected type picks which.
real of_reals(function(real, real) -> real f, real x, y) = f(x, y);
logic of_order(function(real, real) -> logic f, real x, y) = f(x, y);
logic of_logic(function(logic, logic) -> logic f, logic x, y) = f(x, y);
integer of_integers(function(integer, integer) -> integer f, integer x, y) = f(x, y);
complex of_complex(function(complex, complex) -> complex f, complex x, y) = f(x, y);
real[2] of_arrays(function(real[2], real[2]) -> real[2] f, real[2] x, y) = f(x, y);
const a1 = of_reals(#+, 1, 2);          // expect: 3
const a2 = of_reals(#-, 1, 2);          // expect: -1
const a3 = of_reals(#*, 3, 2);          // expect: 6
const a4 = of_reals(#/, 1, 2);          // expect: 0.5
const a5 = of_reals(#%, 7, 2);          // expect: 1
const a6 = of_reals(#^, 3, 2);          // expect: 9
const b1 = of_order(#<, 1, 2);          // expect: true
const b2 = of_order(#>, 1, 2);          // expect: false
const b3 = of_order(#<=, 1, 1);         // expect: true
const b4 = of_order(#>=, 1, 2);         // expect: false
const b5 = of_order(#==, 1, 2);         // expect: false
const b6 = of_order(#!=, 1, 2);         // expect: true
const c1 = of_logic(#and, true, false); // expect: false
const c2 = of_logic(#or, true, false);  // expect: true
const d1 = of_integers(#%, -7, 3);      // expect: 2
const d2 = of_integers(#+, 2147483647, 1);   // expect: -2147483648
const e1 = of_complex(#*, 1i, 1i);      // expect: [-1, 0]
const f1 = of_arrays(#+, [1, 2], [3, 4]);    // expect: [4, 6]
