// A recursion whose end depends on the hit runs in the machine.
integer fac(integer n) = select 1, if n <= 1; n * fac(n - 1) otherwise end;
integer a() = fac(integer(10 * $position.z));       // expect: 3628800
