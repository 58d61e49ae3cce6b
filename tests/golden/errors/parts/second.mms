// The other.
const thing = 3;
