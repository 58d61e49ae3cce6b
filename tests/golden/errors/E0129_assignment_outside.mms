// Values are defined in bodies.
   scale = 4.0;
// ^^^^^ error E0129
