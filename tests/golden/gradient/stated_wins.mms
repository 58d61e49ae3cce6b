// A stated gradient is taken as it is.
surface s
    height = $uv.x;
    gradient = [7, 8];
end
// expect-output: surface s gradient = [7, 8]
