// The numbers of the material that is not chosen are not computed.
real forever(real x) = forever(x + 1);
surface s
//      ^ warning W0402: `$view`
    bsdf = select matte(0.25), if $view.x * $view.x >= 0; glossy(0.5, forever($uv.x)) otherwise end;
end
// expect-output: surface s bsdf = mix(matte(0.25), glossy(0.5, 0), 0)
