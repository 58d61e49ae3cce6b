// A recursion over materials that has no end at link is an error, not a hang.
material f(integer n) = mix(f(n + 1), matte(), 0.5);
surface s bsdf = f(0); end
//               ^^^^ error E0301
