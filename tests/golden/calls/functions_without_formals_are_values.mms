// The bare name of a function without formals is its value; calling it does too.
real half() = 0.5;
const a = half;                        // expect: 0.5
const b = half() + half;               // expect: 1
real c() = $position.z * half;         // expect: 0.5
