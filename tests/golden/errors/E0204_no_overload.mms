// No candidate takes these arguments; the candidates are listed.
const a = sin("x");
//        ^^^^^^^^ error E0204: there is `real sin(real x)`
real f(real x, y) = x;
const b = f(1);
//        ^^^^ error E0204: its argument `y` is missing
const c = f(1, 2, 3);
//        ^^^^^^^^^^ error E0204: it takes 2 arguments, found 3
const d = f(1, x = 2);
//        ^^^^^^^^^^^ error E0204: is given twice
const g = f(true, 1);
//        ^^^^^^^^^^ error E0204: does not take `logic`
