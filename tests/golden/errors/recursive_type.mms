// A type does not contain itself.
   list typeid struct real head; list tail; end;
// ^^^^ error E0220: this is defined in terms of itself
   loop typeid loop;
// ^^^^ error E0220: this is defined in terms of itself
