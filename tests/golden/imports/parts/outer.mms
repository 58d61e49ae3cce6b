// Keeps another file under a name of its own.
import "shapes.mms" as inner;
const doubled = inner::twice_of(inner::shape_count);
