// A local that nobody reads.
real f(real x)
    y = 2 * x;
//  ^ warning W0401: `y`
    return x;
surface s
    detail = 3;
//  ^^^^^^ warning W0401
    bsdf = matte(0.5);
end
