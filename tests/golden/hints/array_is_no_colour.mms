// Three numbers in brackets are no colour.
param spectrum tint = [0.6, 0.05, 0.02];
//                    ^^^^^^^^^^^^^^^^^ error E0203: write `rgb(r, g, b)`
surface s
    bsdf = matte(tint);
end
