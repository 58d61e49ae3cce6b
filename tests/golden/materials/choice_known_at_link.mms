// A choice that is known at link leaves one material.
param logic metal = true;
surface s bsdf = select mirror(0.5), if metal; matte(0.5) otherwise end; end
// expect-output: surface s bsdf = mirror(0.5)
