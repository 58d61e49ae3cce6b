// Adjacent nested functions may call each other.
integer f(integer n)
    integer a(integer k) = select 0, if k == 0; 1 + b(k - 1) otherwise end;
    integer b(integer k) = select 0, if k == 0; 10 + a(k - 1) otherwise end;
    return a(n);
const p = f(4);                                     // expect: 22
integer q() = f(integer(4 * $position.z));          // expect: 22
