// Imports what its importer imports too.
import "shapes.mms";
real four_of(real x) = twice_of(twice_of(x));
