// A sum of octaves whose number is known at link time.
surface s
    height = 0.1 * fbm($object_position, 4);
end
// check-gradient: surface s
