// No overload fits: all there are, with their types.
real area(real width, height) = width * height;
real area(real[2] size) = size.x * size.y;
const a = area(true);
//        ^^^^^^^^^^ error E0204: there is `real area(real[2] size)`
const b = area(1, 2);
