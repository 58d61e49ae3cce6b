// The four logical operations.
const a = true and true;         // expect: true
const b = true and false;        // expect: false
const c = false or true;         // expect: true
const d = false or false;        // expect: false
const e1 = not false;            // expect: true
const f = not not true;          // expect: true
logic g() = $position.z > 0 and not ($position.z > 2);    // expect: true
logic h() = true == ($position.z > 2);                    // expect: false
logic i() = true != ($position.z > 2);                    // expect: true
