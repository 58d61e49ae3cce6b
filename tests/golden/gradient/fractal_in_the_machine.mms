// A recursion left for the machine is differentiated too.
surface s
    height = 0.1 * fbm($object_position, 2 + integer(abs($time)));
end
// check-gradient: surface s
