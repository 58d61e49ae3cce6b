// An index known only at run time is a choice; outside, the nearest end is taken.
const v = [10, 20, 30];
integer at(integer i) = v[i];
integer a() = at(integer(1 * $position.z));      // expect: 20
integer b() = at(integer(9 * $position.z));      // expect: 30
integer c() = at(integer(-9 * $position.z));     // expect: 10
real d() = [1, 2; 3, 4][integer($position.z), integer($time)];   // expect: 3
