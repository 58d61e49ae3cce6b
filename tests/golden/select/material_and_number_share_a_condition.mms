// One condition may choose several outputs.
surface s
    inside = $uv.x < 0.5;
    bsdf = select mix(matte($uv.x), mirror(0.5), 0.5), if inside; mix(matte(0.25), mirror($uv.y), 0.75) otherwise end;
    scattering = select 0.5, if inside; 1 otherwise end;
end
// expect-output: surface s bsdf at uv=(0.25,1) = mix(matte(0.25), mirror(0.5), 0.5)
// expect-output: surface s bsdf at uv=(0.75,1) = mix(matte(0.25), mirror(1), 0.75)
// expect-output: surface s scattering at uv=(0.75,1) = 1
