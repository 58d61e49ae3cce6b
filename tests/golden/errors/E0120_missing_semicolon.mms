// Definitions end with `;`.
surface s
    a = 1
//       ^ error E0120
    bsdf = matte(a);
end
