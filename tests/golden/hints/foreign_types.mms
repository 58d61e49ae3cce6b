// Names of types in other languages.
   float f(int n) = n;
// ^^^^^ error E0149: there is no type `float`
//         ^^^ error E0149: there is no type `int`
   vec3 g(color c) = 1;
// ^^^^ error E0149: there is no type `vec3`
//        ^^^^^ error E0149: there is no type `color`
