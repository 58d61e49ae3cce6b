// Two files with one name.
import "parts/first.mms";
import "parts/second.mms";
const a = thing;
//        ^^^^^ error E0314: `thing`
const b = only_here;
