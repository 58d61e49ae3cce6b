// The arms widen to the type they share.
const a = select 1, if true; 2.5 otherwise end;                          // expect: 1
const b = select 1, if false; 2i otherwise end;                          // expect: [0, 2]
spectrum c() = select 1, if $time > 0; spectrum(0.5) otherwise end;      // expect: 0.5
real[2] d() = select [1, 2], if $time == 0; [0.5, 0.5] otherwise end;    // expect: [1, 2]
