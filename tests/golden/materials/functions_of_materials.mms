// Materials are values: functions take and give them, and nothing of that is left.
material coat(material base, real amount) = fresnel_mix(base, mirror(amount), 1.5);
material red() = matte(0.25);
surface s bsdf = coat(coat(red, 1), 0.5); end
// expect-output: surface s bsdf = fresnel_mix(fresnel_mix(matte(0.25), mirror(1), 1.5), mirror(0.5), 1.5)
// expect-info: surface s bsdf = constant
