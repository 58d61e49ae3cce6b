// A point has digits on both sides.
const a = .5;
//        ^^ error E0109
const b = 5.;
//        ^^ error E0109
