// The shortest useful material: coloured plastic with a glossy skin.
param spectrum colour = rgb(0.55, 0.03, 0.02), label = "Colour";

surface plastic
    bsdf = fresnel_mix(matte(colour), glossy(colour = 1, gloss = 300.0), ior = 1.5);
end
