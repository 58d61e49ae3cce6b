// The type of what a function gives must follow from the types of its arguments.
const a = map(function(f) -> f(2), [function(x) -> x + 1, function(x) -> x * x]);
//        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0226: `generic U`
