// A structure is made by its name, by position or by field; fields are read with a dot.
ray typeid struct real[3] origin, dir; real t; end;
const r = ray([1, 2, 3], [0, 0, 1], 5);                    // expect: [1, 2, 3, 0, 0, 1, 5]
const s = ray(t = 5, dir = [0, 0, 1], origin = [1, 2, 3]);
const a = r == s;                      // expect: true
const b = r.origin.y + s.t;            // expect: 7
real[3] at(ray q) = q.origin + q.t * q.dir;
const c = at(r);                       // expect: [1, 2, 8]
ray d() = ray($position, $normal, 2);  // expect: [0, 0, 1, 0, 0, 1, 2]
