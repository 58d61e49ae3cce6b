// The element type and the size of an array may both be open.
generic T first(T[generic n] v, generic T unused) = v[0];
generic T second(generic T[n] v) = v[n - 1];
const a = second([1, 2, 3]);           // expect: 3
const b = second([1i, 2i]);            // expect: [0, 2]
const c = first([1.5, 2], 0.0);        // expect: 1.5
