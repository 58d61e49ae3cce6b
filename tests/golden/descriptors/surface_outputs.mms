// Every output of a surface.
surface s
    bsdf = mirror(0.5);
    scattering = 0.5;
    absorption = rgb(0.25, 0.25, 0.25);
    emission_function = glossy(1, 10);
    emission = 3;
    height = 0.5 * $position.x;
    gradient = [1, 2];
    bound = 0.75;
end
// expect-output: surface s bsdf = mirror(0.5)
// expect-output: surface s scattering = 0.5
// expect-output: surface s absorption = 0.25
// expect-output: surface s emission_function = glossy(1, 10)
// expect-output: surface s emission = 3
// expect-output: surface s height at position=(3,0,0) = 1.5
// expect-output: surface s gradient = [1, 2]
// expect-output: surface s bound = 0.75
// expect-info: surface s height = varying reads $position
