// A select has a last arm without a condition.
const a = select 1, if true; end;
//                           ^^^ error E0132
