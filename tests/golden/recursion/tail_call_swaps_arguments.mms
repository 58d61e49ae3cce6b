// The arguments of a tail call are all evaluated before the next round.
real fib(integer n, real a, b) = select a, if n == 0; fib(n - 1, b, a + b) otherwise end;
real f() = fib(integer(20 * $position.z), 0, 1);    // expect: 6765
