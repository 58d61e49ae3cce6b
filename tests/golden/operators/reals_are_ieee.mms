// Division by zero, infinities and NaN follow IEEE 754.
const a = 1.0 / 0.0;             // expect: inf
const b = -1.0 / 0.0;            // expect: -inf
const c = 0.0 / 0.0;             // expect: nan
logic d() = 0.0 / 0.0 == 0.0 / 0.0;     // expect: false
logic e1() = 0.0 / 0.0 != 0.0 / 0.0;    // expect: true
logic f() = 1.0 / $time > 1e30;         // expect: true
logic g() = $time / $time < 1 or $time / $time >= 1;   // expect: false
