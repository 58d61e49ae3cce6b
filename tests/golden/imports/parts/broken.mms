// Has an error.
real broken(real x) = x + nowhere;
