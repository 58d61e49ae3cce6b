// Ramps between knots: at knots, at jumps, outside, of numbers, arrays and spectra.
const k = [0.1, 0.3, 0.3, 0.9];                                                          // expect: [0.1, 0.3, 0.3, 0.9]
const v = [1.0, 2.0, 5.0, 7.0];                                                          // expect: [1, 2, 5, 7]
const a0 = map(function(t) -> ramp(t, k, v), [-1, 0.1, 0.2, 0.3, 0.6, 0.9, 4]);          // expect: [1, 1, 1.5, 5, 6, 7, 7]
const a1 = map(function(t) -> ramp_steps(t, k, v), [-1, 0.1, 0.2, 0.3, 0.6, 0.9, 4]);    // expect: [1, 1, 1, 5, 5, 7, 7]
const a2 = map(function(t) -> ramp_smooth(t, k, v), [-1, 0.15, 0.2, 0.3, 0.6, 0.9, 4]);  // expect: [1, 1.15625, 1.5, 5, 6, 7, 7]
const a3 = ramp(0.5, [0, 1], [[1.0, 2], [3, 6]]);                                        // expect: [2, 4]
const a4 = ramp(0.25, [0, 1], [0i, 2 + 4i]);                                             // expect: [0.5, 1]
const a5 = ramp(0.5, [0.5], [3.0]);                                                      // expect: 3
const a6 = knot_before(0.3, k);                                                          // expect: 2
