// The same file with a name and without.
import "parts/shapes.mms" as s;
import "parts/shapes.mms";
const a = s::twice_of(3) + twice_of(3);    // expect: 12
const b = s::box(1, 2) == box(1, 2);       // expect: true
