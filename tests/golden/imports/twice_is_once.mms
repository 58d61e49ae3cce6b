// A file that is imported twice is there once.
import "parts/shapes.mms";
import "parts/shapes.mms";
import "parts/more.mms";
const a = twice_of(3) + four_of(1);    // expect: 10
