// Rows are equally long.
const m = [1, 2; 3];
//               ^ error E0131
