// What does not fit is told where the script says it.
const a = map(function(x) -> x and true, [1, 2]);
//                           ^^^^^^^^^^ error E0206
const b = map(#cross, [1.0, 2.0]);
//            ^^^^^^ error E0204: no `cross` takes (real)
