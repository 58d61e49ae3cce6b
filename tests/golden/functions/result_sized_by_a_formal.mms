// An integer formal that is known at link may be the size of the result.
real[n] ramp(integer n, real step) = array(n, function(i) -> i * step);
const a = ramp(3, 0.5);                                            // expect: [0, 0.5, 1]
real[n] wrong(integer n) = [1.0, 2.0];
const b = wrong(2);                                                // expect: [1, 2]
