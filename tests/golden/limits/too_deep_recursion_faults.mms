// More than 256 open calls are given up.
integer sum(integer n) = select 0, if n == 0; n + sum(n - 1) otherwise end;
integer a() = sum(integer(300 * $position.z));     // fault: CallDepth line 2
integer b() = sum(integer(250 * $position.z));     // expect: 31375
