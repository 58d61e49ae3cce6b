// The slope of an expression is the gradient of a height that is that expression: here, in a function,
// of what a function took, and of what is not the height.
real hills(real[3] p) = 0.1 * perlin(3 * p) + 0.02 * sin(9 * p.x);
real[2] twice(real h) = 2 * slope(h);
surface here
    h        = hills($object_position);
    height   = h;
    gradient = slope(h);
end
// check-gradient: surface here
surface within
    h        = $uv.x ^ 2 * $uv.y;
    height   = h;
    gradient = 0.5 * twice(h);
end
// check-gradient: surface within
surface part
    height   = 0.3 * $uv.y + hills($object_position);
    gradient = slope(0.3 * $uv.y) + slope(hills($object_position));
end
// check-gradient: surface part
surface still
    height   = 3;
    gradient = slope(3);
end
// expect-output: surface still gradient = [0, 0]
