// A constant height has no gradient, and neither is computed.
surface s
    height = 0.5;
end
// expect-output: surface s gradient = [0, 0]
// expect-info: surface s gradient = constant
