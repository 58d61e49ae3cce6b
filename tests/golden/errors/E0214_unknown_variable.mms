// Variables are those of the table.
real f() = $positon.x;
//         ^^^^^^^^ error E0214: did you mean `$position`?
spectrum g() = $rgb_red;
//             ^^^^^^^^ error E0214
