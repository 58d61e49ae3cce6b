// A param has a default, and may have a range and words for a tool.
param real scale = 4.0 in [0.1, 20], label = "Scale", unit = "m", page = "Main";
param integer n = 3;
param logic on = true;
param real[3] p = [1, 2, 3];
param spectrum c = 0.5;
const a = scale * n;                   // expect: 12
const b = p.y;                         // expect: 2
const d = select c, if on; 0 otherwise end;   // expect: 0.5
