// Division, remainder, powers, negation.
surface s
    height = $position.x / (2 + $position.y ^ 2) + ($position.z % 0.7) - (-$uv.x) ^ 3;
end
surface t
    height = 5 % (1.5 + $uv.y ^ 2);
end
// check-gradient: surface s
// check-gradient: surface t
