// What the grammar does not foresee here.
surface s
    bsdf = matte(0.5 0.2);
//                   ^^^ error E0101: the number `0.2`
    scattering = );
//               ^ error E0101: expected an expression
end
