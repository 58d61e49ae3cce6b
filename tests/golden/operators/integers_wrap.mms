// Integers are 32 bits and wrap.
const most = 2147483647;         // expect: 2147483647
const a = 2147483647 + 1;        // expect: -2147483648
const b = -2147483648 - 1;       // expect: 2147483647
const c = 65536 * 65536;         // expect: 0
const d = -(-2147483648);        // expect: -2147483648
integer e1() = integer($position.z) * 2147483647 + 2;   // expect: -2147483647
