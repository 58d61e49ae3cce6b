// A structure takes each field once.
pair typeid struct real a, b; end;
const p = pair(1);
//        ^^^^^^^ error E0230: its field `b` is missing
const q = pair(1, 2, 3);
//        ^^^^^^^^^^^^^ error E0230
const r = pair(a = 1, c = 2);
//        ^^^^^^^^^^^^^^^^^^ error E0230
const s = pair(1, a = 2);
//        ^^^^^^^^^^^^^^ error E0230
