// What a recursion hands on has no known width: it is found before, and handed on.
real slow(real x, integer k) = select x, if k <= 0; slow(x / 2 + filter_width(x), k - 1) otherwise end;
//                                                               ^^^^^^^^^^^^^^^ error E0310: what a recursion hands on
real fine(real x, width, integer k) = select width, if k <= 0; fine(x / 2, width / 2, k - 1) otherwise end;
surface s
    height = slow($uv.x, integer(9 * $uv.y));
end
surface t
    height = fine($uv.x, filter_width($uv.x), integer(9 * $uv.y));
end
