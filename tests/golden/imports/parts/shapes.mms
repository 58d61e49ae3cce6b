// Imported by the scripts in the folder above.
real twice_of(real x) = 2 * x;
const shape_count = 2;
box typeid struct real width, height; end;
corner typeid enum round, sharp;
