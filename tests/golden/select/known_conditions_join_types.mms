// The type is that of all arms, whichever is taken, so that it never depends on what is known.
integer kind(integer x) = 1;
integer kind(real x) = 2;
integer kind(complex x) = 3;
const a = kind(select 1, if true; 2.5 otherwise end);                  // expect: 2
const b = kind(select 1, if false; 2, if true; 2.5 otherwise end);     // expect: 2
const c = kind(select 1, if true; 2 otherwise end);                    // expect: 1
const d = kind(select 1, if true; 2i, if false; 2.5 otherwise end);    // expect: 3
real fac(integer n) = select 1, if n <= 1; n * fac(n - 1) otherwise end;
const m = fac(5);                                                      // expect: 120
