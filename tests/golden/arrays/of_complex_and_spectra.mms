// Elements of every kind, indexed at the hit too.
const a = [1i, 2, 3.0];                                   // expect: [0, 1, 2, 0, 3, 0]
spectrum[2] s() = [spectrum(1), 0.5];                     // expect: [1, 0.5]
spectrum b() = s[integer($uv.x) + 1];                     // expect: 0.5
complex c() = a[integer(0 * $uv.x)];                      // expect: [0, 1]
const d = [1i, 2] == [complex(0, 1), 2];                  // expect: true
