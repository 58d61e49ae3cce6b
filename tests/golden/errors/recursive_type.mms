// A type does not contain itself.
list typeid struct real head; list tail; end;
//                            ^^^^ error E0215: unknown type `list`
   loop typeid loop;
//             ^^^^ error E0215: unknown type `loop`
