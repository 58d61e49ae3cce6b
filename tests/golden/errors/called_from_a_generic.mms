// An error in a generic function stands in its text, and the call that made it is shown.
T twice(generic T a) = a + a;
//                     ^^^^^ error E0206: `twice` is called here
const k = twice(true);
