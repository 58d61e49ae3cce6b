// Division by zero, infinities and NaN follow IEEE 754.
const a = 1.0 / 0.0;             // expect: inf
//        ^^^^^^^^^ warning W0403: division by zero
const b = -1.0 / 0.0;            // expect: -inf
//        ^^^^^^^^^^ warning W0403: division by zero
const c = 0.0 / 0.0;             // expect: nan
//        ^^^^^^^^^ warning W0403: division by zero
logic d() = 0.0 / 0.0 == 0.0 / 0.0;     // expect: false
//          ^^^^^^^^^ warning W0403: division by zero
//                       ^^^^^^^^^ warning W0403: division by zero
logic e1() = 0.0 / 0.0 != 0.0 / 0.0;    // expect: true
//           ^^^^^^^^^ warning W0403: division by zero
//                        ^^^^^^^^^ warning W0403: division by zero
logic f() = 1.0 / $time > 1e30;         // expect: true
logic g() = $time / $time < 1 or $time / $time >= 1;   // expect: false
