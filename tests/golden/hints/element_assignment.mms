// Parts of a value are not assigned.
surface s
    x = [1, 2];
    x[0] = 3;
//       ^ error E0101: expected a name, found `=`
    bsdf = matte(x.x);
end
