// Every operator has a function.
logic rel(function(real, real) -> logic f) = f(1, 2);
logic con(function(logic, logic) -> logic f) = f(true, false);
const a = rel(#<);                     // expect: true
const b = rel(#>);                     // expect: false
const c = rel(#<=);                    // expect: true
const d = rel(#>=);                    // expect: false
const e1 = rel(#==);                   // expect: false
const g = rel(#!=);                    // expect: true
const h = con(#and);                   // expect: false
const i = con(#or);                    // expect: true
