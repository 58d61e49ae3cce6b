// What lies above a coat is denser than it.
surface s
    bsdf = coat(microfacet(1, 0.3), matte(0.5), ior = 0.8);
//  ^^^^ warning W0409: a coat of index 0.8 counts as one of the inverse
end
surface in_a_mixture
    bsdf = mix(matte(0.5), coat(mirror(), tilt(glossy(), 0.1, 0), ior = 0.9), 0.5);
//  ^^^^ warning W0409: a coat of index 0.9 counts as one of the inverse
end
surface a_part_of_a_coat
    bsdf = fresnel_mix(matte(0.5), coat(glossy(), matte(0.5), ior = 0.9));
//  ^^^^ warning W0409: a coat of index 0.9 counts as one of the inverse
end
// Water under varnish.
surface below_another
    bsdf = coat(mirror(), coat(glossy(), matte(0.5), ior = 0.89));
end
surface below_a_mix
    bsdf = fresnel_mix(coat(glossy(), matte(0.5), ior = 0.89), mirror());
end
surface known_only_at_run_time
    bsdf = coat(glossy(), matte(0.5), ior = 0.5 + $uv.x);
end
surface not_there
    bsdf = coat(glossy(), matte(0.5), ior = 1);
end
surface by_a_mix
    bsdf = fresnel_mix(matte(0.5), mirror(), 0.8);
//  ^^^^ warning W0409: a coat of index 0.8 counts as one of the inverse
end
