// Several arguments of one generic type widen to the type they share.
generic T add_up(generic T p, T q) = p + q;
const a = add_up(1, 2.5);              // expect: 3.5
const b = add_up(1i, 2);               // expect: [2, 1]
const c = add_up([1, 2], [0.5, 0.5]);  // expect: [1.5, 2.5]
