// A unit that is none.
const a = 3inch;
//         ^^^^ error E0111: `inch` is no unit
const b = 2pi;
//         ^^ error E0111: for a product write `2 * pi`
