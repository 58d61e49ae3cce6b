// A condition is logic.
real f(real x) = select 1, if x; 2 otherwise end;
//                            ^ error E0203: expected `logic`, found `real`
