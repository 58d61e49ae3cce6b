// A semicolon alone is an item, and may follow an end.
;;
pair typeid struct real p; end;
surface s ; ; end;
const a = 1;;                          // expect: 1
