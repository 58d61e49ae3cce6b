// What follows from an error is no error of its own.
const a = nope;
//        ^^^^ error E0201: unknown name `nope`
const b = a + true;
const c = [b, 1][0].x;
surface s
    bsdf = c;
end
