// The chain of calls is told, the innermost first.
T third(generic T a) = a < a;
//                     ^^^^^ error E0203: `first` is called here
T second(generic T a) = third(a);
T first(generic T a) = second(a);
const k = first(1);
