// One name of a file is enough.
import "noise" as n;
import "../imports/parts/shapes.mms";
surface s
    height = twice_of(n::perlin($position));
end
// near: inf
