// A surface reaches to its `end`.
surface s
    bsdf = matte(0.5);
   surface t
// ^^^^^^^ error E0122: the surface begins here
end
