// What is wrong once is told once, however often it is called.
real bad(real x) = x + nowhere;
//                     ^^^^^^^ error E0201: unknown name `nowhere`
const a = bad(1);
const b = bad(2) + bad(3);
