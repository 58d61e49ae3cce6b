// A file that imports itself by way of another has no beginning.
import "parts/back.mms";
const here = 1;
// error E0313: circular.mms -> back.mms -> circular.mms
