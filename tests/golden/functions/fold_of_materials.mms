// Materials fold like anything else: how many there are is known at link.
surface s
    bsdf = fold(#+, matte(0), map(function(c) -> c * mirror(), [0.25, 0.5]));
end
// expect-output: surface s bsdf = add(add(matte(0), scale(mirror(1), 0.25)), scale(mirror(1), 0.5))
