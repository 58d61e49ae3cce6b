// Calls that are not in tail position may be 256 deep.
integer sum(integer n) = select 0, if n == 0; n + sum(n - 1) otherwise end;
integer a() = sum(integer(200 * $position.z));      // expect: 20100
