// The rules of the library's rows and of its modules.
surface s
    height = smoothstep(-1, 1, $uv.x) + length($position) + atan2($uv.y, 3) + exp(-$uv.x ^ 2) + max($position.x, $position.y);
end
surface t
    height = worley($position) + hypot($uv.x, 1) + tanh($position.z) + mix(0.0, 1.0, $uv.y) + 2 ^ $uv.x;
end
// check-gradient: surface s
// check-gradient: surface t
