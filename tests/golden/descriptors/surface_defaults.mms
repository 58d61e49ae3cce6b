// What a surface does not state has a default.
surface s end
// expect-output: surface s bsdf = matte(1)
// expect-output: surface s scattering = 1
// expect-output: surface s absorption = 0
// expect-output: surface s emission_function = matte(1)
// expect-output: surface s emission = 0
// expect-output: surface s height = 0
// expect-output: surface s gradient = [0, 0]
// expect-output: surface s bound = 0
// expect-info: surface s scattering = constant
