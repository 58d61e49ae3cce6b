// Enumerators are written `type::name`; they compare, convert to integers and choose.
finish typeid enum polished, oiled, bare;
const a = integer(finish::oiled);               // expect: 1
const b = finish::bare == finish::bare;         // expect: true
const c = finish::bare != finish::polished;     // expect: true
real gloss(finish k) = select 90.0, if k == finish::polished; 40.0, if k == finish::oiled; 1.0 otherwise end;
const d = gloss(finish::oiled);                 // expect: 40
const e1 = gloss(finish::bare);                 // expect: 1
finish choice() = select finish::bare, if $position.z > 0; finish::oiled otherwise end;   // expect: 2
real f() = gloss(choice);                       // expect: 1
const g = real(finish::bare);                   // expect: 2
