// Arrays hold structures, enumerations and logic values too.
pair typeid struct real a, b; end;
const v = [pair(1, 2), pair(3, 4)];    // expect: [1, 2, 3, 4]
const a = v[1].a;                      // expect: 3
const b = [true, false][1];            // expect: false
logic c() = [$time > 1, $time < 1][integer($position.z)];     // expect: true
