// Arm by arm; a step has derivative 0.
real ramp(real x) = select 0.0, if x < 0; 2 * x, if x < 1; 2.0 otherwise end;
const a = gradient(#ramp, -1.0);    // expect: 0
const b = gradient(#ramp, 0.5);     // expect: 2
const c = gradient(#ramp, 3.0);     // expect: 0
const d = gradient(#floor, 3.5);    // expect: 0
