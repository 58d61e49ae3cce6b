// Thesis Figure 4.8: how many wavelengths a cluster takes. Gold, red paint, a line of a spectrum as wide
// as 30 nm, and a ball that glows like a fluorescent lamp: with four wavelengths their colours are noise.
// The thesis shows 4, 8 and 12 wavelengths in a scene of its own, with 200000 clusters for 640x480 pixels,
// two for three pixels; here they are 8, 4 and 1, for 12 do not fit a cluster, and a cluster a pixel is the least.
//
//   mms render clusters.mms --scene glossy.json --surface metal --size 512x144 --samples 1 -o eight.png
//   ... --estimator four -o four.png, --estimator single -o one.png

surface metal
    bsdf = gold(0.2);
end

surface paint
    bsdf = matte(rgb(0.8, 0.05, 0.03));
end

surface line
    bsdf = matte(0.9 * max(1 - abs($wavelength - 520nm) / 30nm, 0));
end

surface tube
    bsdf     = matte(0);
    emission = 0.1 * illuminant_f($wavelength, 11);
end
