// = does not compare.
const n = 1;
const a = select 1, if n = 0; 2 otherwise end;
//                       ^ error E0145: write `==`
