// A material whose size is not known at link.
material layers(real x, material m) = select m, if x > 10; layers(x + 1, m + matte(0.1)) otherwise end;
surface s bsdf = layers($time, matte(0)); end
//               ^^^^^^^^^^^^^^^^^^^^^^^ error E0301
