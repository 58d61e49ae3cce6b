// `alias` gives a name another one; descriptors are aliased by strings.
real half(real x) = x / 2;
halve alias half;
"oak" alias "wood";
root alias sqrt;
surface wood bsdf = matte(0.5); end
const a = halve(3);                    // expect: 1.5
const b = root(16.0);                  // expect: 4
// expect-output: surface wood bsdf = matte(0.5)
