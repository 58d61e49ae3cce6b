// Arrays are counted from 0; x y z w are the first four.
const a = [1, 2, 3][1];                // expect: 2
const v = [1.5, 2.5, 3.5, 4.5];        // expect: [1.5, 2.5, 3.5, 4.5]
const b = v.x + v.w;                   // expect: 6
const c = [1, 2.5];                    // expect: [1, 2.5]
const d = v[2 - 1];                    // expect: 2.5
real f() = $position[2] + $uv.y;       // expect: 1
