// Inside, a generic type names types of locals and of nested functions.
generic T cube(generic T v)
    T square = v * v;
    T times(T w) = w * v;
    return times(square);
const a = cube(2.0);                   // expect: 8
const b = cube(1i);                    // expect: [0, -1]
