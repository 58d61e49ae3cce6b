// A material recursion that chooses by the hit at each level.
material stack(integer n) = select matte(0.5), if n == 0; select stack(n - 1), if $uv.x < n; mirror(0.25 * n) otherwise end otherwise end;
surface s bsdf = stack(2); end
// expect-output: surface s bsdf at uv=(2.5,0) = mix(mix(matte(0.5), mirror(0.25), 0), mirror(0.5), 1)
// expect-output: surface s bsdf at uv=(1.5,0) = mix(mix(matte(0.5), mirror(0.25), 1), mirror(0.5), 0)
