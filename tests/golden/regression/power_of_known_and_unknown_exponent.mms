// x ^ n is the same number whether the name n is known at link or not.
const integer three = 3;
const integer five = 5;
logic same(real x) = x ^ three == x ^ integer(3 * $position.z) and x ^ five == x ^ integer(5 * $position.z);
logic a() = same(1.1) and same(1.7) and same(0.3) and same(2.9);    // expect: true
