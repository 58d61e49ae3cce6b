// At the top level types come in any order.
ray typeid struct point origin; point dir; end;
point typeid real[dims];
const dims = 3;
real z(ray r) = r.dir.z;
const a = z(ray([0, 0, 0], [1, 2, 3]));     // expect: 3
