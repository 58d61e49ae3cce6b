// Steel brushed along the equator: anisotropic highlights and fine streaks in the roughness.
param real roughness = 0.34 in [0.05, 1], label = "Roughness";

surface brushed_steel
    y       = $object_position.y;
    streaks = fbm([90 * y, 0.8 * $object_position.x, 0.8 * $object_position.z], 4);
    bsdf    = conductor(2.6, 3.5, roughness * (1 + 0.35 * streaks), 0.75);
    height  = 0.0006 * streaks;
end
