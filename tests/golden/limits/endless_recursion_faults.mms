// A tail recursion that never ends is given up, and named by its line.
integer forever(integer n) = forever(n + 1);
integer a() = forever(integer($position.z));    // fault: BackEdges line 2
