// A param that is seen from outside under another name is used.
param real scale = 4.0;
outside alias scale;
surface s end
