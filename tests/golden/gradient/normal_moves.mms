// The normal's change along the surface counts (its shape operator).
surface s
    height = $normal.x * $normal.y + dot($normal, $position);
end
// check-gradient: surface s
