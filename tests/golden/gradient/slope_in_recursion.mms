// What a recursion hands on has no known slope: it is found before, and handed on.
real wrong(real x, integer k) = select x, if k <= 0; wrong(x / 2 + slope(x)[0], k - 1) otherwise end;
//                                                                 ^^^^^^^^ error E0310: what a recursion hands on
surface s
    height = wrong($uv.x, integer(9 * $uv.y));
end
