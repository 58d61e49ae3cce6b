// Functions, constants and types of a body are locals too.
surface s
    real twice(real x) = 2 * x;
//       ^^^^^ warning W0401: `twice` is never used
    const k = 3;
//        ^ warning W0401: `k` is never used
    pair typeid real[2];
//  ^^^^ warning W0401: `pair` is never used
    height = $uv.x;
end
