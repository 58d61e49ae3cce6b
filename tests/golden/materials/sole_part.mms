// A combiner that is equal to one of its parts, by its constants, is that part.
param real weight = 0.0;
surface a bsdf = mix(matte(0.5), mirror(), weight); end
surface b bsdf = mix(matte(0.5), mirror(), 1.0 - weight); end
surface c bsdf = (1.0 - weight) * matte(0.5); end
surface d bsdf = fresnel_mix(matte(0.5), mirror(), 1.0 + weight); end
surface e bsdf = coat(mirror(), matte(0.5), weight, 3.0, 1.0); end
surface f bsdf = coat(mirror(), matte(0.5), 3.0, 0.0, 1.0); end
surface j bsdf = layer(sheen(0.5), matte(0.5), weight); end
surface k bsdf = turn(microfacet(0.5, 0.2, 0.9), weight); end
// A layer of index 1 that absorbs is more than what it covers; so is half of something.
surface g bsdf = coat(mirror(), matte(0.5), 1.0, 3.0, 1.0); end
surface h bsdf = mix(matte(0.5), mirror(), 0.5); end
surface i bsdf = fresnel_mix(matte(0.5), mirror(), 1.01); end
// expect-output: surface a bsdf = matte(0.5)
// expect-output: surface b bsdf = mirror(1)
// expect-output: surface c bsdf = matte(0.5)
// expect-output: surface d bsdf = matte(0.5)
// expect-output: surface e bsdf = matte(0.5)
// expect-output: surface f bsdf = matte(0.5)
// expect-output: surface g bsdf = coat(mirror(1), matte(0.5), 1, 3, 1)
// expect-output: surface h bsdf = mix(matte(0.5), mirror(1), 0.5)
// expect-output: surface i bsdf = fresnel_mix(matte(0.5), mirror(1), 1.01)
// expect-output: surface j bsdf = matte(0.5)
// expect-output: surface k bsdf = microfacet(0.5, 0.2, 0.9)
