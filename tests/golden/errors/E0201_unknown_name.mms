// A name that is not there; the nearest one is offered.
real f(real height) = 2 * heigth;
//                        ^^^^^^ error E0201: did you mean `height`?
real g() = position.x;
//         ^^^^^^^^ error E0201: `$position`
real h()
    y = z;
//      ^ error E0201
    z = 1;
    return y + z;
