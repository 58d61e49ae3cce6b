// Nested dielectrics: tea in a glass. The tea reaches a little into its glass, which has the higher
// `priority`: so the inner wall has the index of glass over that of tea, and no air is between.
//
//   mms render drink.mms --scene drink.json --size 256x320 -o drink.png

surface glass
    bsdf = dielectric(1.52);
end

surface tea
    bsdf = dielectric(1.333);
end

volume tea
    absorption = 1 / 1m * rgb(1.2, 4, 14);
end
