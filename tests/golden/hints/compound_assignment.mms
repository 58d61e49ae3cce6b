// Nothing changes, so nothing is added to.
surface s
    x = 1;
    x += 2;
//    ^^ error E0142
    y = 1;
    y++;
//   ^^ error E0142
    bsdf = matte(x + y);
end
