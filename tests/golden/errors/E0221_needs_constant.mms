// The size of an array is known at link time.
surface s
    n = integer($uv.x);
    real[n] v = [1, 2];
//       ^ error E0221
    bsdf = matte(v.x);
end
