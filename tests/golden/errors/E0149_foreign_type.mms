// Types of other languages are named by their own.
real f(vec3 p) = p.x;
//     ^^^^ error E0149: write `real[3]`
