// Fields that are not there.
pair typeid struct real first, second; end;
finish typeid enum oiled, bare;
const p = pair(1, 2);
const a = p.frist;
//          ^^^^^ error E0211: did you mean `first`?
const b = [1, 2].z;
//               ^ error E0211
const c = finish::oild;
//                ^^^^ error E0211: did you mean `oiled`?
real f(real x) = x.y;
//                 ^ error E0211
