// Parts of a material about normals of their own.
surface mapped bsdf = tilt(matte(0.5), normal_slope([0.0, 0.6, 0.8])); end
surface longer bsdf = tilt(matte(0.5), normal_slope([1.2, 0.0, 1.6])); end
surface flat bsdf = tilt(matte(0.5), normal_slope([0.0, 0.0, 3.0])); end
surface even bsdf = bumped(matte(0.5), 7.0); end
surface plain bsdf = openpbr(base_metalness = 1.0, specular_roughness = 0.0, base_slope = slope(3.0)); end
surface bumpy bsdf = tilt(openpbr(base_metalness = 1.0, specular_roughness = 0.0), 0.5, 0.0); end
surface below bsdf = openpbr(base_metalness = 1.0, specular_roughness = 0.0, base_slope = [0.5, 0.0]); end
// expect-output: surface mapped bsdf = tilt(matte(0.5), 0, -0.75)
// expect-output: surface longer bsdf = tilt(matte(0.5), -0.75, 0)
// expect-output: surface flat bsdf = matte(0.5)
// expect-output: surface even bsdf = matte(0.5)
