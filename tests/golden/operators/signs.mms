// Signs may follow one another, and an operator.
const a = 2 - -3;      // expect: 5
const b = --2;         // expect: 2
const c = 2 * -3;      // expect: -6
const d = not not true;    // expect: true
