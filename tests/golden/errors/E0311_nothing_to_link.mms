// A source that defines nothing.
;
// error E0311: begin with
