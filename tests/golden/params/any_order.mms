// A param may use a type or a constant that is defined further down.
param finish coat = finish::oiled;
param real reach = 2 * base in [0, 10];
param size extent = [1, 2];
finish typeid enum polished, oiled;
const base = 3;
size typeid real[2];
const a = integer(coat);                    // expect: 1
const b = reach;                            // expect: 6
const c = extent.y;                         // expect: 2
