// A file without surfaces is read by others, which may use its params.
param real scale = 4.0;
const a = 2;    // expect: 2
