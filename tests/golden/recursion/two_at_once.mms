// Two recursions whose lanes end at different times.
integer collatz(integer n, steps) = select steps, if n <= 1; collatz(select integer(n / 2), if n % 2 == 0; 3 * n + 1 otherwise end, steps + 1) otherwise end;
integer a() = collatz(integer(27 * $position.z), 0);                         // expect: 111
integer b() = collatz(integer(abs(97 * $position.x) + 6), 0);                // expect: 8
