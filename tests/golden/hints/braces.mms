// Bodies have no braces.
surface s {
//        ^ error E0146
    bsdf = matte(0.5);
}
