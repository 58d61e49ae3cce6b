// Types may be defined in a body.
real f(real x)
    two typeid struct real a, b; end;
    mode typeid enum on, off;
    v = two(x, 3);
    return select v.b, if mode::on == mode::on; v.a otherwise end;
const p = f(1);                        // expect: 3
