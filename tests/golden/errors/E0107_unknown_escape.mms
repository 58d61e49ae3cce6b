// A backslash has a few meanings only.
const a = "c:\d";
//           ^^ error E0107
