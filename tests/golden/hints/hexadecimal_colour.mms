// A colour is no hexadecimal number.
surface s
    bsdf = matte(rgb(0xFF, 0x80, 0x00));
//                   ^^^^ error E0112: numbers are decimal
//                         ^^^^ error E0112: numbers are decimal
//                               ^^^^ error E0112: numbers are decimal
end
