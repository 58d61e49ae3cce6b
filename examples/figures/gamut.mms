// Thesis Figure 6.3: what a tone curve does to colours that a screen cannot show. The upper row is a
// black body of 1500 K, which is redder than the red of sRGB; the lower one of 6600 K, a grey. Each
// patch is 1.25 times as bright as the one to its left.
//
//   mms render gamut.mms --scene gamut.json --size 640x80 -o faded.png              fades to white
//   mms render gamut.mms --scene gamut.json --size 640x80 --view srgb -o cut.png    stays red

const real patches = 20;

surface gamut
    // Both rows begin at a luminance of 0.04, in units of the white of the screen.
    begin    = select 0.04 / 0.1073, if $uv.y > 0.5; 0.04 / 4.537e4 otherwise; end;
    kelvin   = select 1500, if $uv.y > 0.5; 6600 otherwise; end;
    bsdf     = matte(0);
    emission = begin * 1.25^floor(patches * $uv.x) * blackbody(kelvin);
end
