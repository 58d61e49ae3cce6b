// A function that is called in its own argument does not call itself, however many calls there are.
real chain(integer k, real x) = select x, if k == 0; chain(k - 1, x + 0.25) otherwise end;
real row(real x) = fold(#+, 0.0, array(16, function(k) -> chain(6, x)));
real[4] many() = array(4, function(i) -> fold(#+, 0.0, array(8, function(j) -> row(1.0 * j))));  // expect: [640, 640, 640, 640]
