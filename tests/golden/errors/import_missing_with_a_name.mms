// A file that is not there is told once, not again for each name of it.
   import "not/there.mms" as n;
// ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0304: cannot find `not/there.mms` to import
real f(real x) = n::f(x) + n::k;
