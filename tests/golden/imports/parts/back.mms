// Imports the script that imports it.
import "../circular.mms";
const there = here + 1;
