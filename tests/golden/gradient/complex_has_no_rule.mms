// Functions of complex numbers have no rule: the gradient must be stated.
surface s
    height = abs(exp(complex($uv.x, $uv.y)));
//  ^^^^^^ error E0310
end
