// The size of an array is known at link.
real f() = array(integer(3 * $uv.x), function(i) -> 1.0)[0];
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0221
real g() = array(0, function(i) -> 1.0)[0];
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0223
