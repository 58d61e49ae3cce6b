// Functions of functions, of materials and of structures are checked without a call.
real g(function(real) -> real q) = "text";
//                                 ^^^^^^ error E0203
material h(material m) = 1;
//                       ^ error E0203
real k(function(real) -> spectrum q) = q(1);
//                                     ^^^^ error E0203
holder typeid struct material m; function(real) -> real f; end;
material n(holder x) = x.f(1) * x.f;
//                     ^^^^^^^^^^^^ error E0206
