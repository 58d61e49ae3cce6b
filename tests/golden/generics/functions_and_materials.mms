// A generic takes functions and materials too.
generic T same(generic T x) = x;
const a = same(#sqrt)(16.0);                              // expect: 4
surface s bsdf = same(matte(0.25)); end
// expect-output: surface s bsdf = matte(0.25)
