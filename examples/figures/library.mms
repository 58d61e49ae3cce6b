// A picture of each noise and pattern of the library, for docs/stdlib.md; each surface has the name
// of its function. `./run figures` renders them all.
import "screen.mms";

real[2] p() = [5.0 * $position.x, 5.0 * $position.y];
real[2] w() = filter_width(p);
real[3] q() = [p[0], p[1], 0.37];
material dark() = matte(0.0);

// Noise.
surface perlin bsdf = dark; emission = screen_signed(perlin(2 * q)); end
surface hash bsdf = dark; emission = screen(hash([floor(4 * p[0]), floor(4 * p[1])])); end
surface cellnoise bsdf = dark; emission = screen(cellnoise(2 * q)); end
surface worley bsdf = dark; emission = screen(worley(p)); end
surface worley_pair
    f        = worley_pair(p);
    bsdf     = dark;
    emission = screen(f[1] - f[0]);
end
surface voronoi bsdf = dark; emission = screen(voronoi(p)); end
surface simplex bsdf = dark; emission = screen_signed(simplex(2 * p, 0)); end
surface valuenoise bsdf = dark; emission = screen_signed(valuenoise(2 * p, 0)); end
surface white bsdf = dark; emission = screen_signed(white([floor(4 * p[0]), floor(4 * p[1])])); end
surface blocks bsdf = dark; emission = screen_signed(blocks(2 * p)); end
surface worley_f1 bsdf = dark; emission = screen(worley_f1(p)); end
surface worley_f2 bsdf = dark; emission = screen(0.7 * worley_f2(p)); end
surface worley_f3 bsdf = dark; emission = screen(0.6 * worley_f3(p)); end
surface worley_gap bsdf = dark; emission = screen(worley_gap(p)); end
surface worley_edge bsdf = dark; emission = screen(2 * worley_edge(p)); end
surface worley_id bsdf = dark; emission = screen(worley_id(p)); end
surface worley_signed bsdf = dark; emission = screen_signed(worley_signed(p)); end
surface octave_sum
    bsdf     = dark;
    emission = screen(octave_sum(function(v) -> perlin(v)^2, p, 4));
end
surface fbm bsdf = dark; emission = screen_signed(fbm(q, 6)); end
surface turbulence bsdf = dark; emission = screen(turbulence(q, 6)); end
surface ridged bsdf = dark; emission = screen(0.5 * ridged(q, 6)); end
surface multifractal bsdf = dark; emission = screen(0.3 * multifractal(#perlin, q, 6)); end
surface hetero_terrain bsdf = dark; emission = screen(0.15 * hetero_terrain(#perlin, q, 6)); end
surface ridged_multifractal
    bsdf     = dark;
    emission = screen(0.5 * ridged_multifractal(#perlin, q, 6));
end
surface warp
    v        = warp(#perlin, p, 0.6);
    bsdf     = dark;
    emission = screen(checker(2 * v, filter_width(2 * v)));
end
surface domain_warp bsdf = dark; emission = screen_signed(domain_warp(#perlin, q, 0.8, 2)); end
surface curl
    v        = curl(#perlin, p);
    bsdf     = dark;
    emission = screen(0.4 * length(v));
end
surface gabor bsdf = dark; emission = screen_signed(gabor(p, [2.0, 1.0])); end
surface gabor_isotropic bsdf = dark; emission = screen_signed(gabor_isotropic(p, 2.0)); end
surface gabor_sum
    wave     = function(id) -> select [2.5, 0.0], if id < 0.5; [0.0, 2.5] otherwise; end;
    bsdf     = dark;
    emission = screen_signed(0.5 * gabor_sum(wave, p, 0, [0, 0]));
end
surface fbm_tiled
    bsdf     = dark;
    emission = screen_signed(fbm_tiled(#perlin, p, [2.0, 2.0], 5));
end

// Slopes and noises of several numbers: red and green.
surface perlin_gradient bsdf = dark; emission = screen_pair(0.5 * perlin_gradient(p)); end
surface perlin_derivative
    bsdf     = dark;
    emission = screen_signed(0.15 * perlin_derivative(p, 1, 1));
end
surface valuenoise_gradient bsdf = dark; emission = screen_pair(0.4 * valuenoise_gradient(p)); end
surface valuenoise_derivative
    bsdf     = dark;
    emission = screen_signed(0.15 * valuenoise_derivative(p, 0, [0, 0], 1, 1));
end
surface simplex_gradient bsdf = dark; emission = screen_pair(0.4 * simplex_gradient(p)); end
surface simplex_derivative
    bsdf     = dark;
    emission = screen_signed(0.08 * simplex_derivative(p, 0, [0, 0], 1, 1));
end
surface worley_gradient bsdf = dark; emission = screen_pair(worley_gradient(p)); end
surface worley_second_gradient bsdf = dark; emission = screen_pair(worley_second_gradient(p)); end
surface perlin_vector bsdf = dark; emission = screen_pair(perlin_vector(2 * p)); end
surface valuenoise_vector bsdf = dark; emission = screen_pair(valuenoise_vector(2 * p)); end
surface simplex_vector bsdf = dark; emission = screen_pair(simplex_vector(2 * p)); end
surface noise_vector
    bsdf     = dark;
    emission = screen_pair(noise_vector(function(v, s) -> worley_signed(v, s), 2, p));
end
surface worley_distances
    d        = worley_distances(p);
    bsdf     = dark;
    emission = screen_colour(rgb(0.8 * d[0], 0.5 * d[1], 0.4 * d[2]));
end
surface worley_squared
    d        = worley_squared(p);
    bsdf     = dark;
    emission = screen_colour(rgb(d[0], 0.5 * d[1], 0.4 * d[2]));
end

surface flow bsdf = dark; emission = screen_signed(flow(#perlin, q, 6)); end

// Patterns.
surface alternating bsdf = dark; emission = screen_signed(alternating(p[0], w[0])); end
surface checker bsdf = dark; emission = screen(checker(p, w)); end
surface stripes bsdf = dark; emission = screen(stripes(p[0], 0.5, w[0])); end
surface grid bsdf = dark; emission = screen(grid(p, 0.1, w)); end
surface dots bsdf = dark; emission = screen(dots(p, 0.3, w)); end
surface brick
    v        = [p[0], 2.5 * p[1]];
    bsdf     = dark;
    emission = screen(brick(v, 0.08, filter_width(v)));
end
surface brick_position
    v        = brick_position([p[0], 2.5 * p[1]]);
    bsdf     = dark;
    emission = screen(0.5 * (v[0] + v[1]));
end
surface brick_tint bsdf = dark; emission = screen(brick_tint([p[0], 2.5 * p[1]])); end
surface tile bsdf = dark; emission = screen(tile(p, 0.05, 0.12, w)); end
surface hexagon bsdf = dark; emission = screen(hexagon(p, 0.08, w)); end
surface hexagon_centre
    bsdf     = dark;
    emission = screen(1.4 * distance(p, hexagon_centre(p)));
end
surface hexagon_edge bsdf = dark; emission = screen(2 * hexagon_edge(p)); end
surface hexagon_tint bsdf = dark; emission = screen(hexagon_tint(p)); end
surface cracks bsdf = dark; emission = screen(1 - cracks(p, 0.06, w)); end
surface rings
    v        = [p[0] - 2.5, p[1] - 2.5, 0.0];
    bsdf     = dark;
    emission = screen(rings(2 * v, 0.4, filter_width(2 * v)));
end
surface weave
    v        = weave(p, 0.8, w);
    bsdf     = dark;
    emission = screen(0.9 * v[0] + 0.45 * v[1]);
end
surface weave_height bsdf = dark; emission = screen(weave_height(p)); end
surface scratches bsdf = dark; emission = screen(scratches(p, width = w)); end
surface spiral
    v        = [p[0] - 2.5, p[1] - 2.5];
    bsdf     = dark;
    emission = screen(spiral(v, 2, 0.5, w));
end
surface gradient_linear bsdf = dark; emission = screen(gradient_linear(p, [1, 1], [4, 4])); end
surface gradient_radial bsdf = dark; emission = screen(gradient_radial(p, [2.5, 2.5], 2.5)); end
surface gradient_angular
    bsdf     = dark;
    emission = screen(gradient_angular([p[0] - 2.5, p[1] - 2.5]));
end
surface cell_random bsdf = dark; emission = screen(cell_random(2 * p, 0)); end
surface bomb
    bsdf     = dark;
    emission = screen(bomb(function(v, r) -> (0.4 + 0.6 * r) * step(length(v), 0.2 + 0.3 * r), p));
end
