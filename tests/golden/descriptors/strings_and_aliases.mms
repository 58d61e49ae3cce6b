// A descriptor's name may be a string, and be seen under another one.
surface "old-oak"
    bsdf = matte(0.5);
end
"oak" alias "old-oak";
volume "old-oak"
    scattering = 2;
end
// expect-output: surface old-oak bsdf = matte(0.5)
// expect-output: volume old-oak scattering = 2
