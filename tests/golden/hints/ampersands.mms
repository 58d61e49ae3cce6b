// && and || and ! are words here.
logic a() = true && false;
//               ^^ error E0140: write `and`
logic b() = true || false;
//               ^^ error E0140: write `or`
logic c() = !true;
//          ^ error E0140: write `not`
