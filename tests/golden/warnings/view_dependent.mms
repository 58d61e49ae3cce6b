// A bsdf that reads $view is not reciprocal.
surface s
//      ^ warning W0402: the bsdf of `s`
    bsdf = matte(0.5 + 0.25 * $view.z);
end
