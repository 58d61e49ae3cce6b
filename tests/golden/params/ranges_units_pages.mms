// All that may follow a param's default.
param real s = 2.0 in [0, 10], label = "Scale", unit = "m", page = "Grain";
param integer n = 3 in [1, 8];
param logic on = true, label = "On";
const a = select n * s, if on; 0 otherwise end;    // expect: 6
