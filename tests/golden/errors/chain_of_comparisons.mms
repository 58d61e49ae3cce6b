// A chain of comparisons has one type.
logic a() = 1 < 2 < true;
//          ^^^^^^^^^^^^ error E0206: `<` does not combine `integer` and `logic`
