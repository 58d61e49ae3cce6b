// The modules of the library, differentiated.
import "patterns" as p;
import "noise" as n;
surface s
    height = p::rings($position) + 0.1 * n::turbulence($object_position, 3) + 0.1 * n::ridged([$uv.x, $uv.y], 2);
end
surface t
    height = p::brick($uv) + bias(saturate($uv.x), 0.3) + gain(saturate($uv.y), 0.7) + remap($uv.x, 0, 1, 2, 5);
end
// check-gradient: surface s
// check-gradient: surface t
