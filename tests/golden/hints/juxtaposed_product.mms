// (a + b)(c) is a call of something that is no function.
const a = (1 + 2)(3);
//        ^^^^^^^ error E0208: multiplication is written with `*`
