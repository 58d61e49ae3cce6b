// A surface has outputs, no value.
surface s
    return matte(0.5);
//  ^^^^^^ error E0125
end
