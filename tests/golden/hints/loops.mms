// There are no loops.
real f(real x)
    for (i = 0; i < 3; i = i + 1) y = x;
//  ^^^ error E0147: recursion
    return 2;
