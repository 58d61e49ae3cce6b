// Words of the grammar are no names.
surface s
    end = 1;
//  ^^^ error E0126
    bsdf = matte(0.5);
end
