// A module of the library can be imported under a name.
import "noise" as n;
import "patterns" as p;
const a = n::perlin([0.0, 0.0, 0.0]);          // expect: 0
const b = p::checker([0.5, 1.5]);              // expect: 1
