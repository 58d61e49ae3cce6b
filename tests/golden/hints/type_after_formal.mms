// The type comes first.
real f(a real) = a;
//       ^^^^ error E0126: the keyword `real` cannot be a name
