// Files may import each other; each is there once.
import "parts/back.mms";
const here = 1;
const a = there + 1;                   // expect: 3
