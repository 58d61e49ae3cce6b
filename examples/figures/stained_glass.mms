// Thesis Figure 6.2: a window of stained glass that light passes with its direction kept, and the
// coloured shadow that it throws. `free` says how much is scattered and absorbed: rays pass without
// a vertex, shadow rays too. `ordinary` is the same glass as a material that lets light straight
// through: shadow rays end at it, and only paths that happen to meet the lamp light the shadow.
//
//   mms render stained_glass.mms --scene stained_glass.json --surface free -o free.png
//   mms render stained_glass.mms --scene stained_glass.json --surface ordinary -o ordinary.png

const real[2] at = [7 * $uv.x, 10 * $uv.y];
const real pane = worley_id(at);
const real lead = 1 - smoothstep(0.03, 0.05, worley_edge(at));
const spectrum tint = rgb(0.15 + 0.8 * hash(pane), 0.1 + 0.5 * hash(pane + 1),
    0.15 + 0.8 * hash(pane + 2));
const spectrum dust = mix(0.04, 1, lead);
const spectrum skin = mix(0.8, 0.03, lead);

surface free
    bsdf       = matte(skin);
    scattering = dust;
    absorption = 1 - tint;
end

surface ordinary
    bsdf = mix(refraction(ior = 1, colour = tint), matte(skin), dust);
end
