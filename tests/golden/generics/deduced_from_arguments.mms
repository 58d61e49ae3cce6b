// `generic T` introduces a type in the formals; the call deduces it.
generic T twice(generic T v) = v + v;
const a = twice(3);                    // expect: 6
const b = twice(1.5);                  // expect: 3
const c = twice(1 + 2i);               // expect: [2, 4]
const d = twice([1, 2]);               // expect: [2, 4]
spectrum f() = twice(spectrum(0.25));  // expect: 0.5
