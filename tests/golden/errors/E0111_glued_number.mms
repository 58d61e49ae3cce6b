// A name glued to a number is a unit or nothing.
const a = 3miles;
//         ^^^^^ error E0111: `miles`
