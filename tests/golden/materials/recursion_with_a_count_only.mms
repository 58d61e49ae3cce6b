// A function of materials that needs a number known at link is right if every call of it knows the number.
material pile(integer n) = select matte(0.5), if n == 0; mix(pile(n - 1), mirror(), 0.5) otherwise end;
surface s bsdf = pile(1); end
// expect-output: surface s bsdf = mix(matte(0.5), mirror(1), 0.5)
