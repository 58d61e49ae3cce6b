// Arrays have square brackets.
const a = {1, 2, 3};
//        ^ error E0146: `{` is no bracket here
