// An import that is nowhere.
   import "no/such/file.mms";
// ^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0304
   import "nose" as n;
// ^^^^^^^^^^^^^^^^^^^ error E0304: did you mean the library's `noise`?
