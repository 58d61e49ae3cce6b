// What a volume does not state has a default.
volume v end
// expect-output: volume v phase = isotropic()
// expect-output: volume v scattering = 0
// expect-output: volume v absorption = 0
// expect-output: volume v emission_function = isotropic()
// expect-output: volume v emission = 0
// expect-output: volume v bound = 0
