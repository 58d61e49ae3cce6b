// A param that no surface reads changes nothing.
param real scale = 4.0;
//         ^^^^^ warning W0404: the param `scale` is never used
param real depth = 1.0;
surface s
    height = depth * $uv.x;
end
