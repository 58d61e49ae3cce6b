// Everything has a default, and an empty definition is one.
surface s end
volume v ; ; end
// expect-output: surface s bsdf = matte(1)
// expect-output: volume v phase = isotropic()
