// A real has a largest value.
const a = 1e999;
//        ^^^^^ error E0114
