// A name is given once.
const a = 1;
const a = 2;
//    ^ error E0212: first defined here
surface s
    x = 1;
    x = 2;
//  ^ error E0212
    bsdf = matte(x);
end
surface s end
//      ^ error E0212
pair typeid struct real p, p; end;
//                         ^ error E0212
