// `and` and `or` do not look at the right side where the left decides.
logic forever(integer n) = forever(n + integer($time) + 1);
logic a() = $position.z < 0 and forever(0);    // expect: false
logic b() = $view.z * $view.z >= 0 or forever(0);     // expect: true
logic c() = false and forever(0);              // expect: false
