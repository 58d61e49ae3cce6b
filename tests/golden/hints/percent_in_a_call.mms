// A percentage as an argument.
surface s
    bsdf = matte(50%);
//                 ^ error E0144: write `0.5`
end
