// Mixing two integers gives a real.
const a = mix(0, 1, 0.5);              // expect: 0.5

