// The program knows what each output depends on.
surface s
    bsdf = matte(0.5 * $uv.x);
    scattering = 0.5;
    absorption = $wavelength / 1um;
    emission = rgb(1, 0.5, 0.25);
    height = 0.1 * $object_position.z;
end
// expect-info: surface s bsdf = varying reads $uv
// expect-info: surface s scattering = constant
// expect-info: surface s absorption = varying spectral reads $wavelength
// expect-info: surface s emission = varying spectral reads $rgb_red $rgb_green
// expect-info: surface s height = varying reads $object_position
// expect-info: surface s gradient = varying reads $object_tangent $object_bitangent
