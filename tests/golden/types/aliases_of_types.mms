// `typeid` names a type; the name is the type itself.
point typeid real[3];
scalar typeid (real);
row typeid scalar[2];
real f(point p) = p.x + p.z;
const a = f([1, 2, 3]);          // expect: 4
scalar g() = 2;                  // expect: 2
row h() = [1, 2];                // expect: [1, 2]
map typeid function(real) -> real;
real twice(map m, real x) = m(m(x));
const b = twice(#sqrt, 16.0);    // expect: 2
