// What is captured may be an array, and may come from another machine function.
real f(real[3] v, integer n)
    real sum(integer k, real t)
        return select t, if k > n; sum(k + 1, t + v[k % 3]) otherwise end;
    return sum(0, 0.0);
real g(integer n) = select 0, if n == 0; f([1.0, n, 3], n) + g(n - 1) otherwise end;
real a() = g(integer(3 * $position.z));                                      // expect: 16
const b = g(3);                                                              // expect: 16
