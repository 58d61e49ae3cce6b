// A structure may hold what exists only at link time.
kit typeid struct material m; function(real) -> real f; string name; end;
surface s
    k = kit(matte(0.25), #sqrt, "k");
    bsdf = k.m;
    scattering = k.f(0.25);
end
// expect-output: surface s bsdf = matte(0.25)
// expect-output: surface s scattering = 0.5
