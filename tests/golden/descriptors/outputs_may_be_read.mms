// An output is a name like any other.
surface s
    height = $uv.x * 2;
    scattering = height / 4;
end
// expect-output: surface s scattering at uv=(1,0) = 0.5
