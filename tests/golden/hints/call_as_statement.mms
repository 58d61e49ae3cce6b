// A call alone is nothing.
surface s
    print(3);
//  ^^^^^ error E0147: a call
    bsdf = matte(0.5);
end
