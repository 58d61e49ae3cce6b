// == compares whole values: all elements and fields.
pair typeid struct real a; integer b; end;
const a = [1, 2, 3] == [1, 2, 3];            // expect: true
const b = [1, 2, 3] == [1, 2.5, 3];          // expect: false
const c = pair(1, 2) == pair(1, 2);          // expect: true
const d = pair(1, 2) != pair(1, 3);          // expect: true
const e1 = (1 + 2i) == complex(1, 2);        // expect: true
logic f() = $position == [0.0, 0.0, 1.0];    // expect: true
logic g() = $position != [0.0, 0.0, 1.0];    // expect: false
const h = (1 == 1.0) == true;                // expect: true
