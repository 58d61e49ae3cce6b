// A bare formal has its neighbour's type: `T` here is a name.
real f(real a, T) = a + T;
const x = f(1, 2);    // expect: 3
