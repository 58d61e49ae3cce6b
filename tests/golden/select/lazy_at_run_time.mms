// Only the chosen arm is run: the other may never end.
integer forever(integer n) = forever(n + 1 + integer(0 * $time));
integer a() = select 7, if $view.x * $view.x >= 0; forever(0) otherwise end;     // expect: 7
integer b() = select forever(0), if $view.x * $view.x < 0; 8 otherwise end;      // expect: 8
