// Vectors of any dimension.
const a = dot([1, 2, 3], [4, 5, 6]);           // expect: 32
const b = length([3, 4]);                      // expect: 5
const c = distance([0, 0, 0], [2, 3, 6]);      // expect: 7
const d = normalize([0, 0, 4]);                // expect: [0, 0, 1]
const e1 = cross([1, 0, 0], [0, 1, 0]);        // expect: [0, 0, 1]
const f = reflect([1, -1], [0, 1]);            // expect: [1, 1]
const g = dot([1.5], [2]);                     // expect: 3
const h = normalize([0.0, 0.0]);               // expect: [0, 0]
real i() = dot($normal, $view);                // expect: 1
