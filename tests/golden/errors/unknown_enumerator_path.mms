// What is before `::` is a file's name or an enumeration.
finish typeid enum oiled, bare;
const a = finish::oiled::deep;
//        ^^^^^^^^^^^^^^^^^^^ error E0201: unknown name `finish::oiled::deep`
const b = nothing::oiled;
//        ^^^^^^^^^^^^^^ error E0201: unknown name `nothing::oiled`
