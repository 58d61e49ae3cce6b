// The shape of an emission may have any weight.
surface s
    emission = 1;
    emission_function = matte(0.7) + matte(0.7);
end
