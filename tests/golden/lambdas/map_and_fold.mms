// Higher-order functions over arrays, unrolled at link.
real fold_up(function(real, real) -> real f, real start, real[n] v)
    real go(integer k, real t) = select t, if k == n; go(k + 1, f(t, v[k])) otherwise end;
    return go(0, start);
const a = fold_up(#+, 0, [1, 2, 3, 4]);                               // expect: 10
const b = fold_up(#*, 1, [1, 2, 3, 4]);                               // expect: 24
const c = fold_up(function(t, x) -> max(t, x), -1, [3, 7, 5]);        // expect: 7
real d() = fold_up(#+, 0, $position);                                 // expect: 1
