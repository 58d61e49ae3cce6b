// The first arm whose condition holds is the value.
real f(real x) = select 1, if x < 1; 2, if x < 2; 3, if x < 3; 4 otherwise end;
const a = f(0.5);                      // expect: 1
const b = f(1.5);                      // expect: 2
const c = f(2.5);                      // expect: 3
const d = f(9);                        // expect: 4
real e1() = f(1.5 * $position.z);      // expect: 2
