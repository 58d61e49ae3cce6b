// What is no function is not called.
real f(real x)
    y = 2 * x;
    return y(3);
//         ^^^^ error E0208: written with `*`
const a = (1 + 2)(3);
//        ^^^^^^^ error E0208
colour typeid enum red, green;
const b = colour(1);
//        ^^^^^^^^^ error E0208
