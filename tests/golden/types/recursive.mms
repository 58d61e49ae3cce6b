// A type cannot contain itself.
   node typeid struct real value; node next; end;
// ^^^^ error E0220
