// Parts given in full add up; what is known at link is counted.
surface s
    bsdf = matte(0.7) + mirror(0.5);
//  ^^^^ warning W0407: the weights of this material add up to 1.2
end
surface t
    bsdf = 0.7 * matte(1) + 0.5 * mirror(1);
//  ^^^^ warning W0407: the weights of this material add up to 1.2
end
surface u
    bsdf = 0.7 * matte(1) + 0.3 * mirror(1);
end
surface v
    bsdf = matte($uv.x) + mirror(0.9);
end
surface w
    bsdf = mix(matte(1.5), matte(1.5), 0.5);
//  ^^^^ warning W0407: the weights of this material add up to 1.5
end
surface x
    bsdf = fresnel_mix(matte(0.9), mirror(0.9)) + matte(0.2);
//  ^^^^ warning W0407: the weights of this material add up to 1.1
end
surface y
    bsdf = glossy_refraction(1.5, 60, 20);
//  ^^^^ warning W0407: the weights of this material add up to 60
end
surface z
    bsdf = dielectric(1.5, 0.2, 1.1, 1.3);
//  ^^^^ warning W0407: the weights of this material add up to 1.1
end
