// A name for a file that is never said, and a file of which nothing is used.
import "noise" as n;
//                ^ warning W0405: nothing of `n` is used
   import "../imports/parts/shapes.mms";
// ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning W0405: nothing of `../imports/parts/shapes.mms` is used
surface s end
