// There are no statements.
real f(real x)
    if (x > 0) y = 1;
//  ^^ error E0147
    return 2;
