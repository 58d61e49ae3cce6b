// A machine function may give structures, logic values and enumerators.
mode typeid enum idle, busy;
state typeid struct real v; logic done; mode m; end;
state run(state s, integer n) = select s, if n == 0; run(state(s.v * 2, not s.done, mode::busy), n - 1) otherwise end;
state a() = run(state(1, false, mode::idle), integer(3 * $position.z));      // expect: [8, true, 1]
