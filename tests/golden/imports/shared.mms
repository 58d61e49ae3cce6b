// A file that two others take in is visible in both, and there once.
import "parts/shapes.mms";
import "parts/more.mms" as m;
const a = m::four_of(1) + twice_of(1); // expect: 6
