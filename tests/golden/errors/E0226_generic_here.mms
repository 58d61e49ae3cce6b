// A generic type is introduced by a formal.
   generic T f(real x) = x;
// ^^^^^^^^^ error E0226: `generic T`
const a = f(1);
