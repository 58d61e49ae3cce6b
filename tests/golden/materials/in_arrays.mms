// Arrays of materials, indexed at link or at run time.
surface s
    m = [matte(0.1), matte(0.2), matte(0.3)];
    bsdf = m[1];
    emission_function = m[integer($position.z)];
end
// expect-output: surface s bsdf = matte(0.2)
// expect-output: surface s emission_function at position=(0,0,2) = matte(0.3)
