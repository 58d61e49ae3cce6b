// A value on the command line belongs to a param.
// error E0306: did you mean `scale`
// param: scal=2
param real scale = 4.0;
const a = scale;
