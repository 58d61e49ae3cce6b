// A select chooses complex numbers whole.
complex a() = select 1 + 1i, if $time > 0; 2 - 3i otherwise end;     // expect: [2, -3]
