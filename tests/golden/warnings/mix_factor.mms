// The factor of a mixture, and of a scaled material, is a part of the whole.
surface s
    bsdf = mix(matte(0.5), mirror(0.9), 1.5);
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning W0406: the factor 1.5 is outside 0 .. 1
end
surface t
    bsdf = mix(matte(0.5), mirror(0.9), -0.5);
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning W0406: the factor -0.5 is outside 0 .. 1
end
surface u
    bsdf = 2 * matte(0.4);
//         ^^^^^^^^^^^^^^ warning W0406: the factor 2 is outside 0 .. 1
end
surface v
    bsdf = mix(matte(0.5), mirror(0.9), $uv.x);
end
surface w
    bsdf = mix(matte(0.5), mirror(0.9), 1);
end
