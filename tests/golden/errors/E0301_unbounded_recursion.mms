// A recursion over materials must end by what is known at link.
material coats(integer n, material m) = select m, if n == 0; coats(n - 1, mix(m, matte(1), 0.5)) otherwise end;
surface s
    bsdf = coats(integer($uv.x), matte(0.2));
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0301: `material`
end
