// `if`, `else if` and `else` are one message.
real f(real x)
    if (x > 1) y = 1; else if (x > 0) y = 2; else y = 3;
//  ^^ error E0147: `if` is a statement; a script has only definitions
    return x;
