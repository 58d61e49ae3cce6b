// A function with formals is no value without its arguments.
real f(real x) = x;
const a = f;
//        ^ error E0219: #f
