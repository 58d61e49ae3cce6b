// A call in tail position costs no stack, however often it is taken.
integer count(integer n, total) = select total, if n == 0; count(n - 1, total + n % 7) otherwise end;
integer a() = count(integer(3000 * $position.z), 0);     // expect: 8998
