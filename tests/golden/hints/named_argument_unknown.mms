// `f(a = b)` with no formal of that name lists the formals there are.
surface s
    bsdf = glossy(color = 1, shininess = 40);
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0204: it has no argument `color`
end
