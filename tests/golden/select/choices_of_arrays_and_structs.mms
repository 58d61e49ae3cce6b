// A select chooses whole values, element by element.
hit typeid struct real[2] p; integer n; logic l; end;
hit h() = select hit([1, 2], 3, true), if $time > 0; hit([4, 5], 6, false) otherwise end;   // expect: [4, 5, 6, 0]
real a() = h.p.y + h.n;                                                                     // expect: 11
