// Every variable that a script can read.
// near: 1e-3
surface s
    v = [$position.x, $object_position.x, $normal.z, $geometric_normal.z, $tangent.x, $bitangent.y,
         $uv.x, $view.z, $distance, $footprint[0, 0], $time];
    emission = v[0] + 2 * v[1] + 4 * v[2] + 8 * v[3] + 16 * v[4] + 32 * v[5] + 64 * v[6]
             + 128 * v[7] + 256 * v[8] + 512 * v[9] + 1024 * v[10];
end
// expect-output: surface s emission at uv=(1,0) footprint=(1,0,0,0) time=(1) = 2044
