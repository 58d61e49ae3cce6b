// filter_width is the change across the pixel: exactly, through calls, arrays and choices.
const w0 = filter_width(3.0);                                                    // expect: 0
const w1 = filter_width([1, 2, 3]);                                              // expect: [0, 0, 0]
surface s
    p      = 3 * $position;
    w      = filter_width([p.x, p.x + p.y, p.z]);
    height = w[0] + 10 * w[1];
end
// expect-output: surface s height at footprint=(0.01,0,0,0.02) tangent=(1,0,0) bitangent=(0,1,0) = 0.7008203932
// expect-output: surface s height at footprint=(0,0,0,0) = 0
surface t
    height = filter_width(select sin($object_position.x), if $uv.x > 0.5; 2 * $uv.x otherwise end);
end
// expect-output: surface t height at footprint=(0,0,0,0) = 0
