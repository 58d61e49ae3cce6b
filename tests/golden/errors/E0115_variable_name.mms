// `$` is followed by a name.
real f() = $;
//         ^ error E0115
