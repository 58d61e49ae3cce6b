// A local's type may be stated or left out; a stated one converts by widening.
real f()
    a = 2;
    real b = 3;
    const c = 4;
    real[2] d = [a, c];
    return a / b + d.y;          // expect: 4.666666666666667
