// A body defines before it uses: constants, types, functions, names.
surface s
    const k = 0.5;
    tint typeid enum light, dark;
    real shade(tint t) = select k, if t == tint::light; k / 2 otherwise end;
    spectrum colour = shade(tint::dark);
    bsdf = matte(colour);
end
// expect-output: surface s bsdf = matte(0.25)
