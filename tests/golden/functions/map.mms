// `map` keeps the size and takes any element.
pair typeid struct real a, b; end;
const a = map(#abs, [-1.0, 2]);                              // expect: [1, 2]
const b = map(function(x) -> x * x, [1, 2, 3]);              // expect: [1, 4, 9]
const c = map(function(x) -> [x, -x], [1, 2]);               // expect: [1, -1, 2, -2]
const d = map(function(row) -> row.x + row.y, [1, 2; 3, 4]); // expect: [3, 7]
const k = map(function(p) -> p.b, [pair(1, 2), pair(3, 4)]); // expect: [2, 4]
const m = map(function(x) -> x > 1, [1, 2]);                 // expect: [false, true]
const n = map(function(x) -> pair(x, 2 * x), [5])[0].b;      // expect: 10
real twice(real x) = 2 * x;
const q = map(#twice, [1, 2]);                               // expect: [2, 4]
real at_hit() = map(function(x) -> x + $time, [1.0, 2])[1] - $time;   // expect: 2
