// A recursion over materials must end by numbers known at link time.
param integer layers = 3;
material stack(integer n, material m) = select m, if n == 0; stack(n - 1, mix(m, mirror(0.5), 0.25)) otherwise end;
surface s bsdf = stack(layers, matte(0.2)); end
// expect-output: surface s bsdf = mix(mix(mix(matte(0.2), mirror(0.5), 0.25), mirror(0.5), 0.25), mirror(0.5), 0.25)
