// A generic type may be used in a formal before the one that introduces it.
real[n] map_over(T[n] v, function(generic T) -> real f)
    real[n] go(integer k, real[n] done) = done;
    return go(0, 2 * v);
const a = map_over([1.0, 2], #sqrt);   // expect: [2, 4]
