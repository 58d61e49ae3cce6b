// A choice between materials of two shapes is a mix of weight 0 or 1.
surface s
    bsdf = select matte(0.25), if $position.z > 0; mirror(0.75) otherwise end;
end
// expect-output: surface s bsdf at position=(0,0,1) = mix(matte(0.25), mirror(0.75), 0)
// expect-output: surface s bsdf at position=(0,0,-1) = mix(matte(0.25), mirror(0.75), 1)
