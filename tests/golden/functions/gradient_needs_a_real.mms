// Of a function to reals only.
const a = gradient(function(x) -> [x, x], 2.0);
//        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0203: expected `real`, found `real[2]`
