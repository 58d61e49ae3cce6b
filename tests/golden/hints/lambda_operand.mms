// A lambda as an operand wants parentheses.
const a = 1 + function(x) -> x;
//            ^^^^^^^^ error E0150
