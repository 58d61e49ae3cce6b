// The last arm may have its `;`, and a condition any logic.
real f(real x) = select 1, if x < 0 or x > 9; 2, if not (x == 5); 3 otherwise; end;
const a = f(-1);    // expect: 1
const b = f(4);     // expect: 2
const c = f(5);     // expect: 3
