// A type may stand in parentheses, and be an array of them.
real f((real)[3] p) = p[0] + p[2];
const a = f([1, 2, 3]);    // expect: 4
