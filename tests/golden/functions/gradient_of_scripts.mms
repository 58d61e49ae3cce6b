// The exact gradient of any function of reals, by forward differentiation.
real bowl(real[2] q) = q.x ^ 2 + 3 * q.y ^ 2;
const a = gradient(#bowl, [1.0, 2.0]);                                  // expect: [2, 12]
const b = gradient(function(q) -> q.x * q.y * q.z, [2, 3, 5]);          // expect: [15, 10, 6]
const c = gradient(#sin, 0.0);                                          // expect: 1
const d = gradient(function(t) -> t ^ 3, 2);                            // expect: 12
const k = gradient(function(t) -> 7.0, 2);                              // expect: 0
const m = gradient(function(q) -> q[3] / q[0], [2.0, 0, 0, 8]);         // expect: [-2, 0, 0, 0.5]
