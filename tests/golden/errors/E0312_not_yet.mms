// A name that is kept for later.
real f() = image("wood.png", $uv);
//         ^^^^^^^^^^^^^^^^^^^^^^ error E0312: `image`
