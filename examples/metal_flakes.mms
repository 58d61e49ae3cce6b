// Metallic paint under a clear coat: each flake of metal has a normal of its own, the coat is smooth.
param spectrum colour = rgb(0.02, 0.09, 0.3), label = "Colour";
param real spread = 0.25 in [0, 1], label = "Spread of normals";
param real size = 0.012 in [0.001, 0.1], label = "Size of flakes", unit = "m";

surface metal_flakes
    flake = worley_id($object_position / size);
    lean  = spread * [white(flake, 1) + white(flake, 2), white(flake, 3) + white(flake, 4)];
    metal = coloured_metal(mix(colour, rgb(0.5, 0.6, 0.7), 0.3 * hash(flake, 5)), 1.0, 0.3);
    bsdf  = coat(mirror(), mix(matte(0.3 * colour), tilt(metal, lean), 0.8), 0.0);
end
