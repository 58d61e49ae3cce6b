// Arms that share no type are told even where the link decides.
const a = select 1, if true; [1, 2] otherwise end;
//        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0216
