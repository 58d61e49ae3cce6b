// Points without digits, and two of them.
const a = 1..2;
//        ^^^^ error E0109: a number has digits on both sides of its point
const b = [.25, 3.];
//         ^^^ error E0109: a number has digits on both sides of its point
//              ^^ error E0109: a number has digits on both sides of its point
