// The range binds a value that is given from outside too.
// param: s=5
// error E0233: `s` is 5
param real s = 1 in [0, 2];
