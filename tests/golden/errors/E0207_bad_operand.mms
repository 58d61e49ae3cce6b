// What signs do not apply to.
const a = not 1;
//        ^^^^^ error E0207
const b = -true;
//        ^^^^^ error E0207
const c = -"x";
//        ^^^^ error E0207
