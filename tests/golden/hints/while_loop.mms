// Nor is there `while`.
real f(real x)
    while (x < 3) { x = x + 1; }
//  ^^^^^ error E0147: `while` is a statement; a script has only definitions
    return x;
