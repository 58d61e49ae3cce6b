// Functions at the top level may call one another in any order.
logic even(integer n) = select true, if n == 0; odd(n - 1) otherwise end;
logic odd(integer n) = select false, if n == 0; even(n - 1) otherwise end;
const a = even(10);    // expect: true
const b = odd(7);      // expect: true
