// A doc comment and other comments mean nothing.
/// A doc comment, /* a comment in it */ and
// comments everywhere mean nothing.
const /* one */ a /* two */ = /* three */ 1 /* four */ ; // five
/* six
   seven */ const b = a /* eight */ + 1;   // expect: 2
