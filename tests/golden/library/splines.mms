// Splines against Hermite, de Boor and de Casteljau, at and beyond the ends too.
const t = [-1.0, 0.0, 0.1, 0.25, 0.4, 0.77, 1.0, 2.0];       // expect: [-1.0, 0.0, 0.1, 0.25, 0.4, 0.77, 1.0, 2.0]
const v = [1.0, 4.0, 2.0, 2.0, -1.0];                        // expect: [1.0, 4.0, 2.0, 2.0, -1.0]
const h = [0.0, 1.0, 3.0, 2.0, 1.0, 0.5, 4.0];               // expect: [0.0, 1.0, 3.0, 2.0, 1.0, 0.5, 4.0]
const a0 = map(function(u) -> spline_linear(u, v), t);       // expect: [1.0, 1.0, 2.2, 4.0, 2.8, 1.7599999999999998, -1.0, -1.0]
const a1 = map(function(u) -> spline_catmull_rom(u, v), t);  // expect: [1.0, 1.0, 2.4400000000000004, 4.0, 2.896, 1.861568, -1.0, -1.0]
const a2 = map(function(u) -> spline_b(u, v), t);            // expect: [1.0, 1.0, 2.1466666666666665, 3.166666666666667, 2.818666666666667, 1.3706559999999999, -1.0, -1.0]
const a3 = map(function(u) -> spline_bezier(u, h), t);       // expect: [0.0, 0.0, 0.6880000000000002, 1.75, 2.2720000000000002, 1.368524, 4.0, 4.0]
const a4 = map(function(u) -> spline_monotone(u, v), t);     // expect: [1.0, 1.0, 2.848, 4.0, 2.7039999999999997, 1.971968, -1.0, -1.0]
const x = [0.0, 0.5, 0.75, 2.0, 3.0];                        // expect: [0.0, 0.5, 0.75, 2.0, 3.0]
const a5 = map(function(u) -> ramp_monotone(u, x, v), t);    // expect: [1.0, 1.0, 2.08, 3.25, 3.88, 2.0, 2.0, 2.0]
const a6 = spline_catmull_rom(0.4, [[1, 0.0], [3, 1.0]]);    // expect: [1.8, 0.4]
const a7 = spline_b(0.4, [1 + 0i, 3 + 1i]);                  // expect: [1.8, 0.4]
const a8 = spline_linear(0.7, [5]);                          // expect: 5
const a9 = spline_linear(0.5, [1, 4]);                       // expect: 2.5
const b0 = spline_monotone(0.3, [1.0, 2.0]);                 // expect: 1.3
