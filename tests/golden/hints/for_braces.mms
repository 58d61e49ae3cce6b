// A loop with a body in braces is one message.
real f(real x)
    for (i = 0; i < 3; i++) {
//  ^^^ error E0147: `for` is a statement; a script has only definitions
        x = x + i;
        x = 2 * x;
    }
    return x;
