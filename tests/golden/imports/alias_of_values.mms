// Functions, constants and types under other names.
size typeid real[2];
area typeid integer;
extent alias size;
const two = 2;
pair alias two;
real half(real x) = x / 2;
halved alias half;
real first(extent p) = p.x;
const a = first([pair, 1]);                 // expect: 2
const b = halved(3);                        // expect: 1.5
noise_of alias perlin;
const c = noise_of([0.0, 0, 0]);            // expect: 0
