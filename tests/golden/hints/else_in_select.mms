// The last arm is `otherwise`.
const a = select 1, if true; else 2 end;
//                           ^^^^ error E0133
