// All levels of an array or structure count.
quad typeid struct real[32, 32] a, b, c, d; end;
   more typeid struct quad q; real one; end;
// ^^^^ error E0223: an array or structure of 4097 elements; there are 1 to 4096
   five typeid struct quad q, r; end;
// ^^^^ error E0223: an array or structure of 8192 elements; there are 1 to 4096
