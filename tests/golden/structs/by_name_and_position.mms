// Fields by position, by name, and of several types.
ray typeid struct real[3] origin, dir; integer depth; end;
const a = ray([1, 2, 3], [0, 0, 1], 4).depth;                            // expect: 4
const b = ray(depth = 1, dir = [0, 1, 0], origin = [7, 8, 9]).origin;    // expect: [7, 8, 9]
