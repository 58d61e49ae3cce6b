// A number, or a colour, is made a material by a function.
surface s
    bsdf = 0.5;
//         ^^^ error E0203: expected `material`, found `real`
end
surface t
    bsdf = rgb(1, 0, 0);
//         ^^^^^^^^^^^^ error E0203: write `matte(...)` around it
end
