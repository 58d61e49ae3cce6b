// A function has no `end`.
real f(real x) return 2 * x;
   end
// ^^^ error E0123
const a = f(1);
