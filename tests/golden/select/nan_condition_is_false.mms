// A comparison with NaN is false, so its arm is passed over.
real f(real x) = select 1, if x < 0; 2, if x >= 0; 3 otherwise end;
real a() = f($time / $time);           // expect: 3
const b = f(0.0 / 0.0);                // expect: 3
//          ^^^^^^^^^ warning W0403: division by zero
