// Recursion that branches.
integer fib(integer n) = select n, if n < 2; fib(n - 1) + fib(n - 2) otherwise end;
const a = fib(12);                                  // expect: 144
integer b() = fib(integer(12 * $position.z));       // expect: 144
