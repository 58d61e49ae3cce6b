// A script's own name may not repeat one it imports.
import "parts/shapes.mms";
const shape_count = 5;
//    ^^^^^^^^^^^ error E0212
