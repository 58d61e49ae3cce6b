// Two arrays of one size, element by element.
const a = zip(#*, [1, 2, 3], [4, 5, 6]);                            // expect: [4, 10, 18]
const b = zip(function(x, y) -> x + 1i * y, [1, 2], [3, 4]);        // expect: [1, 3, 2, 4]
const c = zip(#max, [1.0, 5], [2.0, 3]);                            // expect: [2, 5]
