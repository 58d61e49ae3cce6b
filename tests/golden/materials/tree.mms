// A material expression becomes a tree; arguments that are not stated have the library's defaults.
surface s
    bsdf = fresnel_mix(matte(0.5), glossy(colour = 0.9, gloss = 30), ior = 1.4);
end
surface t bsdf = 0.5 * matte(0.2) + mirror(0.3); end
surface u bsdf = mix(matte(), mirror(), 0.25); end
surface v bsdf = matte(0.5) * 0.5; end
// expect-output: surface s bsdf = fresnel_mix(matte(0.5), glossy(0.9, 30), 1.4)
// expect-output: surface t bsdf = add(scale(matte(0.2), 0.5), mirror(0.3))
// expect-output: surface u bsdf = mix(matte(1), mirror(1), 0.25)
// expect-output: surface v bsdf = scale(matte(0.5), 0.5)
