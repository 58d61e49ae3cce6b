// Structures hold structures and are handed over whole.
inner typeid struct real p; integer n; end;
outer typeid struct inner i; complex z; end;
outer make(real x) = outer(inner(x, 2), 1i);
const a = make(3);                     // expect: [3, 2, 0, 1]
const b = make(3).i.n;                 // expect: 2
real f(outer o) = o.i.p * im(o.z);
real g() = f(make($position.z * 4));   // expect: 4
