// Every operator is a function.
real two(function(real, real) -> real op) = op(7, 2);
logic says(function(real, real) -> logic op) = op(7, 2);
logic both(function(logic, logic) -> logic op) = op(true, false);
const a = [two(#+), two(#-), two(#*), two(#/), two(#%), two(#^)];    // expect: [9, 5, 14, 3.5, 1, 49]
const b = says(#<);     // expect: false
const c = says(#>);     // expect: true
const d = says(#<=);    // expect: false
const e = says(#>=);    // expect: true
const f = says(#==);    // expect: false
const g = says(#!=);    // expect: true
const h = both(#and);   // expect: false
const i = both(#or);    // expect: true
