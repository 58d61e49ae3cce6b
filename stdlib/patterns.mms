// SPDX-License-Identifier: Apache-2.0
// Regular and scattered patterns over unit cells; scale the argument to choose their size. `width` is
// `filter_width` of the argument: the value is then the mean over the pixel (a box along the axes)
// instead of that of a point, so that distant patterns go grey instead of aliasing. 0 is sharp; less
// than a ten-thousandth is taken for sharp.

/// Even units count 1, odd ones -1.
/// >>> alternating(1.5)
/// -1
/// >>> alternating(1.0, 0.5)
/// 0
real alternating(real x, width = 0.0)
    real integral(real t) = 1.0 - abs(1.0 - t % 2.0);
    f = x % 2.0;
    return select
        1.0 - 2.0 * step(1.0, f), if width < 1e-4;
        (integral(f + 0.5 * width) - integral(f - 0.5 * width)) / width otherwise;
    end;

/// 0 and 1 in turn on unit squares, cubes, ...
/// >>> checker([0.5, 1.5])
/// 1
/// >>> checker([0.5, 1.5, 3.5])
/// 0
/// >>> checker([0.5, 1.5], [2, 2])
/// 0.5
real checker(real[n] p, width = array(n, function(k) -> 0.0)) = select
    fold(#+, 0.0, map(#floor, p)) % 2.0, if widest(width) <= 0.0;
    0.5 - 0.5 * fold(#*, 1.0, zip(#alternating, p, width)) otherwise;
end;

/// 1 on the first `share` of each unit, else 0.
/// >>> stripes(0.25)
/// 1
/// >>> stripes(0.25, 0.5, 1.0)
/// 0.5
real stripes(real x, share = 0.5, width = 0.0)
    real integral(real t) = floor(t) * share + min(fract(t), share);
    f = fract(x);
    return select
        1.0 - step(share, f), if width < 1e-4;
        (integral(f + 0.5 * width) - integral(f - 0.5 * width)) / width otherwise;
    end;

/// 1 on lines of that width around the borders of unit cells, else 0.
/// >>> grid([0.5, 0.98], 0.1)
/// 1
/// >>> grid([0.3, 0.3], 0.5, [1, 1])
/// 0.75
real grid(real[n] p, real line = 0.1, real[n] width = array(n, function(k) -> 0.0)) =
    1.0 - fold(#*, 1.0,
        zip(function(x, w) -> stripes(x - 0.5 * line, 1.0 - line, w), p, width));

/// The mean of a pattern of shapes with edges: of `distance` to the edge, in cells and positive
/// inside, and `share`, what the shapes cover of all. Near edges the filter is a box across them;
/// where the pixel is nearly as wide as a cell, `share` takes over.
/// >>> coverage(0.0, 0.3, 0.1)
/// 0.5
/// >>> coverage(0.2, 0.3, 1.0)
/// 0.3
real coverage(real distance, share, width) = select
    step(0.0, distance), if width <= 0.0;
    mix(step(0.0, distance, width), share, smoothstep(0.3, 1.0, width)) otherwise;
end;

/// 1 on discs of that radius, at most 1/2, in the middle of unit squares, else 0.
/// >>> dots([0.5, 0.5])
/// 1
/// >>> dots([0.5, 0.5], 0.5, [1, 1])
/// 0.785398163
real dots(real[2] p, real radius = 0.3, real[2] width = [0, 0]) = coverage(
    radius - length([fract(p[0]) - 0.5, fract(p[1]) - 0.5]),
    pi * radius * radius,
    widest(width)
);

/// Where in its brick a point lies, in [0, 1) along both axes: unit bricks, odd courses shifted by half.
/// >>> brick_position([0.25, 1.5])
/// [0.75, 0.5]
real[2] brick_position(real[2] p) = [fract(p[0] + 0.5 * (floor(p[1]) % 2.0)), fract(p[1])];

/// 1 on the bricks of `brick_position`, 0 in the mortar between them, which is `mortar` wide.
/// >>> brick([0.5, 0.5])
/// 1
/// >>> brick([0.5, 0.0], 0.2, [2, 2])
/// 0.64
real brick(real[2] p, real mortar = 0.08, real[2] width = [0, 0])
    real across(real x) = stripes(x - 0.5 * mortar, 1.0 - mortar, width[0]);
    real course(real y) =
        stripes(0.5 * (y - 0.5 * mortar), 0.5 * (1.0 - mortar), 0.5 * width[1]);
    q = brick_position(p);
    return select
        pulse(0.5 * mortar, 1.0 - 0.5 * mortar, q[0])
            * pulse(0.5 * mortar, 1.0 - 0.5 * mortar, q[1]), if widest(width) <= 0.0;
        course(p[1]) * across(p[0]) + course(p[1] + 1.0) * across(p[0] + 0.5) otherwise;
    end;

/// A number in [0, 1) for each brick; 1/2 where bricks are too small for the pixel.
/// >>> brick_tint([0.3, 0.2]) == brick_tint([0.6, 0.9])
/// true
/// >>> brick_tint([0.3, 0.2], [1, 1])
/// 0.5
real brick_tint(real[2] p, width = [0, 0]) = mix(
    0.5,
    cellnoise([p[0] + 0.5 * (floor(p[1]) % 2.0), p[1]]),
    fade(widest(width))
);

/// The height of tiles with bevelled edges: 1 on top, falling over `bevel` to 0 in the joints, which
/// are `joint` wide; 2 bevel + joint is at most 1.
/// >>> tile([0.5, 0.5])
/// 1
/// >>> tile([0.1, 0.5], 0.1, 0.1)
/// 0.5
/// >>> tile([0.1, 0.5], 0.0, 0.5, [1, 1])
/// 0.25
real tile(
    real[n] p,
    real joint = 0.05,
    bevel = 0.1,
    real[n] width = array(n, function(k) -> 0.0)
)
    real ramp(real a, t)
        u = clamp(t - a, 0.0, bevel);
        return 0.5 * u * u / max(bevel, 1e-30) + max(t - a - bevel, 0.0);
    real part(real t) = ramp(0.5 * joint, t) - ramp(1.0 - 0.5 * joint - bevel, t);
    real integral(real t) = floor(t) * (1.0 - joint - bevel) + part(fract(t));
    real along(real x, w)
        f = fract(x);
        return select
            saturate((min(f, 1.0 - f) - 0.5 * joint) / max(bevel, 1e-30)), if w < 1e-4;
            (integral(f + 0.5 * w) - integral(f - 0.5 * w)) / w otherwise;
        end;
    return fold(#*, 1.0, zip(#along, p, width));

/// The middle of the regular hexagon, 1 across, that a point lies in. Rows of hexagons run along the
/// first axis; the middles are a triangular lattice.
/// >>> hexagon_centre([0.1, 0.2])
/// [0, 0]
/// >>> hexagon_centre([0.6, 0.8])
/// [0.5, 0.8660254]
real[2] hexagon_centre(real[2] p)
    real[2] lattice(real[2] shift)
        rows = [1.0, sqrt(3.0)];
        return map(#round, (p - shift) / rows) * rows + shift;
    a = lattice([0.0, 0.0]);
    b = lattice([0.5, 0.5 * sqrt(3.0)]);
    return select a, if dot(p - a, p - a) <= dot(p - b, p - b); b otherwise; end;

/// How far a point is from the edge of its hexagon, in [0, 1/2].
/// >>> hexagon_edge([0.0, 0.0])
/// 0.5
/// >>> hexagon_edge([0.4, 0.0])
/// 0.1
real hexagon_edge(real[2] p)
    q = map(#abs, p - hexagon_centre(p));
    return max(0.5 - max(q[0], 0.5 * q[0] + 0.5 * sqrt(3.0) * q[1]), 0.0);

/// 1 on hexagons, 0 in the joints between them, which are `joint` wide.
/// >>> hexagon([0.0, 0.0])
/// 1
/// >>> hexagon([0.48, 0.0])
/// 0
/// >>> hexagon([0.0, 0.0], 0.1, [1, 1])
/// 0.81
real hexagon(real[2] p, real joint = 0.08, real[2] width = [0, 0])
    size = widest(width);
    line = pulse(-0.5 * joint, 0.5 * joint, hexagon_edge(p), size);
    return mix(1.0 - line, (1.0 - joint) * (1.0 - joint), smoothstep(0.3, 1.0, size));

/// A number in [0, 1) for each hexagon.
/// >>> hexagon_tint([0.1, 0.2]) == hexagon_tint([-0.1, 0.3])
/// true
real hexagon_tint(real[2] p)
    c = hexagon_centre(p);
    return cellnoise([2.0 * c[0] + 0.5, c[1] / (0.5 * sqrt(3.0)) + 0.5]);

/// Cracks between irregular cells of about unit size, as in dry earth: 1 where a point is nearly as
/// far from the second nearest seed as from the nearest, by less than `size`, at most 1; 0 elsewhere.
/// >>> cracks([0.3, 0.7], 0.0)
/// 0
real cracks(real[n] p, real size = 0.05, real[n] width = array(n, function(k) -> 0.0))
    f     = worley_pair(p);
    pixel = widest(width);
    share = 1.0 - exp(-size * (1.0 + 0.9 * size) * (1.4 * n - 0.25));  // measured
    line  = pulse(-size, size, f[1] - f[0], 2.0 * pixel);
    return mix(line, share, smoothstep(0.3, 1.0, pixel));

/// Growth rings of wood around the third axis, one a unit, wavy by `wobble`: 0 growing to 1 across each ring.
/// >>> rings([3.5, 0, 0], wobble = 0)
/// 0.5
/// >>> rings([3.5, 0, 0], 0, [2, 2, 2])
/// 0.5
real rings(real[3] p, real wobble = 0.2, real[3] width = [0, 0, 0]) =
    saw(length([p[0], p[1]]) + wobble * perlin(p), widest(width));

/// Plain weave of threads along the axes, one a unit, `thread` wide: the shares of [warp, weft] that
/// are seen. Warp runs along the second axis. What lacks to 1 are the gaps.
/// >>> weave([0.5, 0.5])
/// [1, 0]
/// >>> weave([0.5, 1.5])
/// [0, 1]
/// >>> weave([0.0, 0.0])
/// [0, 0]
/// >>> weave([0.2, 0.7], 0.5, [2, 2])
/// [0.375, 0.375]
real[2] weave(real[2] p, real thread = 0.8, real[2] width = [0, 0])
    real covered(real x, w) = stripes(x - 0.5 + 0.5 * thread, thread, w);
    real signed(real x, w) =
        2.0 * stripes(0.5 * (x - 0.5 + 0.5 * thread), 0.5 * thread, 0.5 * w) - covered(x, w);
    warp = covered(p[0], width[0]);
    weft = covered(p[1], width[1]);
    both = 0.5 * warp * weft;
    over = 0.5 * signed(p[0], width[0]) * signed(p[1], width[1]);
    return [warp - both + over, weft - both - over];

/// The height of `weave`, in [0, 1]: round threads that pass over and under one another; 0 in gaps.
/// Flat where threads are too thin for the pixel.
/// >>> weave_height([0.5, 0.5], 1.0)
/// 1
/// >>> weave_height([0.5, 0.5], 1.0, [1, 1])
/// 0.5
real weave_height(real[2] p, real thread = 0.8, real[2] width = [0, 0])
    real round(real x)
        u = 2.0 * (fract(x) - 0.5) / thread;
        return sqrt(max(1.0 - u * u, 0.0));
    real strand(real x, along) =
        round(x) * (0.75 + 0.25 * alternating(x) * sin(pi * along));
    height = max(strand(p[0], p[1]), strand(p[1], p[0] + 1.0));
    return mix(0.5, height, fade(widest(width)));

/// Straight random scratches, `length` long, in `layers` directions; `size` is how wide they are and
/// `count` how many there are of a layer in a unit square, at most 1 / length.
/// >>> scratches([0.3, 0.7], 0)
/// 0
real scratches(
    real[2] p,
    integer layers = 4,
    real size = 0.01,
    length = 2.0,
    count = 0.25,
    real[2] width = [0, 0]
)
    pixel = widest(width);
    cell  = [1.0 / (count * length), length];
    real scratch(integer layer)
        angle = 2.39996323 * layer + 0.4;
        q     = [cos(angle) * p[0] + sin(angle) * p[1], cos(angle) * p[1] - sin(angle) * p[0]];
        c     = [q[0] / cell[0], q[1] / cell[1]];
        seed  = [floor(c[0]) + 0.5, floor(c[1]) + 0.5, layer + 0.5];
        side  = (0.1 + 0.8 * cellnoise(seed)) * cell[0];
        tilt  = (0.1 * cell[0] / length) * (2.0 * cellnoise(seed + [0, 0, 64]) - 1.0);
        x     = fract(c[0]) * cell[0] - side - tilt * (fract(c[1]) - 0.5) * length;
        ends  = 0.25 * cellnoise(seed + [0, 0, 128]);
        mean  = size * count * length * 0.75;
        sharp = pulse(-0.5 * size, 0.5 * size, x, pixel)
            * pulse(ends, ends + 0.75, fract(c[1]), pixel / length);
        return mix(sharp, mean, smoothstep(0.1, 0.5, pixel / cell[0]));
    real after(integer layer, real clear) = select
        1.0 - clear, if layer >= layers;
        after(layer + 1, clear * (1.0 - scratch(layer))) otherwise;
    end;
    return after(0, 1.0);

/// 1 on `arms` bands that wind around the origin, a unit further out each turn and arm, else 0;
/// they cover `share`.
/// >>> spiral([0.25, 0.0])
/// 1
/// >>> spiral([5.25, 0.0], 1, 0.5, [1, 1])
/// 0.499...
real spiral(real[2] p, integer arms = 1, real share = 0.5, real[2] width = [0, 0])
    r     = length(p);
    turns = atan2(p[1], p[0]) / tau;
    steep = hypot(1.0, arms / (tau * max(r, 1e-6)));
    return stripes(r - arms * turns, share, steep * widest(width));

/// 0 at and before `from`, 1 at and beyond `to`, growing straight along the line between them.
/// >>> gradient_linear([1, 5], [0, 0], [4, 0])
/// 0.25
real gradient_linear(real[n] p, from, to, width = array(n, function(k) -> 0.0))
    along = to - from;
    size  = dot(along, along);
    return linearstep(0.0, 1.0, dot(p - from, along) / size,
        length(along * width) / size);

/// 0 at `centre`, growing to 1 at that radius and beyond.
/// >>> gradient_radial([3, 4], [0, 0], 10.0)
/// 0.5
real gradient_radial(
    real[n] p,
    centre,
    real radius = 1.0,
    real[n] width = array(n, function(k) -> 0.0)
) = linearstep(0.0, radius, length(p - centre), widest(width));

/// The angle around the origin from the first axis, in turns: 0 growing to 1.
/// >>> gradient_angular([0, 2])
/// 0.25
real gradient_angular(real[2] p, width = [0, 0]) =
    saw(atan2(p[1], p[0]) / tau, widest(width) / (tau * max(length(p), 1e-6)));

/// A random point of each unit square: `channel` numbers independent ones, each in [0, 1).
/// >>> cell_random([3.2, 4.7], 1) == cell_random([3.9, 4.1], 1)
/// true
real cell_random(real[2] p, integer channel) =
    cellnoise([p[0], p[1], channel + 0.5]);

/// Scatters copies of a motif, one in each unit square, moved from the middle by up to half of
/// `jitter`, and gives the largest of what they are at p. `f` gets where p is as seen from the middle
/// of a copy, and a number in [0, 1) that the copy has alone; it must be at most 0 further out than 1.
/// >>> bomb(function(q, id) -> 1 - 2 * length(q), [0.5, 0.5], 0.0)
/// 1
real bomb(function(real[2], real) -> real f, real[2] p, real jitter = 1.0)
    real copy(integer k)
        cell   = map(#floor, p) + [k % 3 - 0.5, floor(k / 3) - 0.5];
        centre = cell + jitter * [cell_random(cell, 0) - 0.5, cell_random(cell, 1) - 0.5];
        return f(p - centre, cell_random(cell, 2));
    real largest(integer k, real so_far) =
        select so_far, if k == 9; largest(k + 1, max(so_far, copy(k))) otherwise; end;
    return largest(1, copy(0));

/// `v` turned by an angle in radians, against the clock: turns the copies of `bomb`.
/// >>> turn([1, 0], 90deg)
/// [0, 1]
real[2] turn(real[2] v, real angle) = [
    cos(angle) * v[0] - sin(angle) * v[1],
    sin(angle) * v[0] + cos(angle) * v[1]
];
