// The arms of a select share a type.
real f() = select 1, if $time > 0; true otherwise end;
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0216
