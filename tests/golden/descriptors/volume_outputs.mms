// Every output of a volume.
volume v
    phase = henyey_greenstein(0.5);
    scattering = 2;
    absorption = 0.5 * $object_position.z;
    emission_function = isotropic;
    emission = 0.25;
    bound = 7;
end
// expect-output: volume v phase = henyey_greenstein(0.5)
// expect-output: volume v scattering = 2
// expect-output: volume v absorption at object_position=(0,0,3) = 1.5
// expect-output: volume v emission = 0.25
// expect-output: volume v bound = 7
