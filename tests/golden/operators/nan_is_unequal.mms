// NaN equals nothing, so != holds for it, inside arrays too.
real nan() = $time / $time;                  // expect: nan
logic a() = nan == nan;                      // expect: false
logic b() = nan != nan;                      // expect: true
logic c() = [1.0, nan] == [1.0, nan];        // expect: false
logic d() = [1.0, nan] != [1.0, nan];        // expect: true
logic e1() = not (nan < 1);                  // expect: true
