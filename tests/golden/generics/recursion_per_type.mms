// A recursive generic function has an instance for each type it is called with.
generic T repeat(generic T v, integer n) = select v, if n == 0; repeat(v + v, n - 1) otherwise end;
real a() = repeat(1.5, integer(3 * $position.z));        // expect: 12
real[2] b() = repeat([1.0, 2], integer(2 * $position.z));  // expect: [4, 8]
complex c() = repeat(1i, integer(3 * $position.z));      // expect: [0, 8]
