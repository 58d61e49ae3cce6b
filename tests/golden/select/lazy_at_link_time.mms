// A branch that is not taken is not even looked at, so it need not fit.
integer down(integer n) = select 0, if n == 0; down(n - 1) otherwise end;
const a = select 1, if true; [1, 2][5] otherwise end;     // expect: 1
const b = select [1, 2][5], if false; 1 otherwise end;    // expect: 1
const c = down(100);                                      // expect: 0
