// A recursion in an argument of itself.
integer ack(integer m, n) = select n + 1, if m == 0; ack(m - 1, 1), if n == 0; ack(m - 1, ack(m, n - 1)) otherwise end;
integer a() = ack(2, integer(3 * $position.z));                              // expect: 9
const b = ack(2, 2);                                                         // expect: 7
