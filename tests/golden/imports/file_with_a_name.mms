// `as` puts the names of a file into a space of their own.
import "parts/shapes.mms" as s;
real twice_of(real x) = 100 * x;
const a = s::twice_of(3);              // expect: 6
const b = twice_of(3);                 // expect: 300
const c = s::box(1, 2).height;         // expect: 2
const d = (#s::twice_of)(4);           // expect: 8
s::box make() = s::box(3, 4);          // expect: [3, 4]
const g = integer(s::corner::sharp);   // expect: 1
