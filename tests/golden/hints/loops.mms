// known-issue: the parser resumes inside the parentheses of `for (;;)` and complains of what it finds
// There are no loops.
real f(real x)
    for (i = 0; i < 3; i = i + 1) y = x;
//  ^^^ error E0147: recursion
    return 2;
