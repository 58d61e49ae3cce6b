// A choice between materials of one shape chooses their numbers.
surface s
    bsdf = select matte(0.25), if $position.z > 0; matte(0.75) otherwise end;
end
// expect-output: surface s bsdf at position=(0,0,1) = matte(0.25)
// expect-output: surface s bsdf at position=(0,0,-1) = matte(0.75)
// expect-info: surface s bsdf = varying reads $position
