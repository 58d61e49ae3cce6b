// One of two files that have a `thing`.
const thing = 1;
const only_here = 2;
