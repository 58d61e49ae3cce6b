// A select may have the last arm only, and a semicolon before its end.
const a = select 3 otherwise end;      // expect: 3
const b = select 3 otherwise; end;     // expect: 3
