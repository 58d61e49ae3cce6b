// Glazed tiles from a picture, whose grout lies deeper; what is far away is filtered.
// The picture is examples/star_tile.png: 128 x 128, made for this.
param real across = 6.0 in [1, 40], label = "Tiles around";

surface "star_tiles"
    at     = [across * 2 * $uv.x, across * $uv.y];
    glaze  = image("star_tile.png", at);
    grout  = step(0.95, max(abs(2 * fract(at.x) - 1), abs(2 * fract(at.y) - 1)));
    bsdf   = mix(fresnel_mix(matte(glaze), mirror(1), ior = 1.5), matte(glaze), grout);
    height = 0.004 * image_value("star_tile.png", at, filter = "bicubic");
end
