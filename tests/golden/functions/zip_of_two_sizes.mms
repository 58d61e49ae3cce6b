// The sizes agree.
const a = zip(#+, [1, 2], [1, 2, 3]);
//        ^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0204: no `zip`
