// height of a polynomial: exact partial derivatives along both tangents.
surface s
    height = 0.5 * $position.x ^ 2 + $position.y * $position.z - 3;
end
// check-gradient: surface s
