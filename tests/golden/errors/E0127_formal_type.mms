// The first formal has a type.
real f(x, y) = x + y;
//     ^ error E0127: `x`
