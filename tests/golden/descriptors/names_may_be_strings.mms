// A descriptor's name is an identifier or a string; a surface and a volume may share it.
surface "wood" bsdf = matte(0.5); end
volume wood scattering = 1; end
surface plain bsdf = matte(0.25); end
// expect-output: surface wood bsdf = matte(0.5)
// expect-output: volume wood scattering = 1
// expect-output: surface plain bsdf = matte(0.25)
