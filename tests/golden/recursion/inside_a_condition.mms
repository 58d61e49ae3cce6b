// A condition may call a recursive function.
integer log_2(integer n) = select 0, if n < 2; 1 + log_2(integer(n / 2)) otherwise end;
real a() = select 1, if log_2(integer(64 * $position.z)) == 6; 2 otherwise end;     // expect: 1
