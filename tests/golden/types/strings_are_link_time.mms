// A string is a value of the linker; it may be a label, and be handed over.
param real s = 4.0 in [0.1, 20], label = "Sc\"a\\le\n", unit = "m", page = "Main";
const name = "wood";
real f(string n) = 1.0;
const a = f(name) + s;           // expect: 5
