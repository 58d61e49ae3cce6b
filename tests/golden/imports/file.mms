// A file is found beside the importing one; its names are the importer's.
import "parts/shapes.mms";
const a = twice_of(3);                 // expect: 6
const b = shape_count;                 // expect: 2
const c = box(1, 2).width;             // expect: 1
