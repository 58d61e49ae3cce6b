// What the renderer knows is written with a dollar.
real f() = position.x + uv.x;
//         ^^^^^^^^ error E0201: `$position`
//                      ^^ error E0201: `$uv`
