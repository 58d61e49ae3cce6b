// A namespace inside a namespace; types and enumerators through it.
import "parts/outer.mms" as outer;
const a = outer::inner::shape_count;                 // expect: 2
const b = outer::inner::box(2, 3).height;            // expect: 3
const c = outer::inner::corner::sharp == outer::inner::corner::round;   // expect: false
outer::inner::box wide(real w) = outer::inner::box(width = w, height = 1);
const d = wide(4).width;                             // expect: 4
const k = outer::doubled;                            // expect: 4
const m = map(#outer::inner::twice_of, [1, 2]);      // expect: [2, 4]
