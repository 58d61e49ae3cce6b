// `n % 0` is 0 for integers, NaN for reals.
const a = 5 % 0;                 // expect: 0
const b = 5.0 % 0.0;             // expect: nan
integer c() = 5 % integer($time);   // expect: 0
real d() = 5.0 % $time;          // expect: nan
