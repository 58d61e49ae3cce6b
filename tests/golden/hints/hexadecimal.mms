// Numbers are decimal.
const a = 0x1F;
//        ^^^^ error E0112
