// SPDX-License-Identifier: Apache-2.0
// Regular patterns over unit cells; scale the argument to choose their size.

/// 0 and 1 in turn on unit squares.
/// >>> checker([0.5, 1.5])
/// 1
real checker(real[2] p) = (floor(p[0]) + floor(p[1])) % 2.0;

/// 0 and 1 in turn on unit cubes.
/// >>> checker([0.5, 1.5, 3.5])
/// 0
real checker(real[3] p) = (floor(p[0]) + floor(p[1]) + floor(p[2])) % 2.0;

/// 1 on the first `share` of each unit, else 0.
/// >>> stripes(0.25)
/// 1
real stripes(real x, share = 0.5) = 1.0 - step(share, fract(x));

/// 1 on discs of that radius in the middle of unit squares, else 0.
/// >>> dots([0.5, 0.5])
/// 1
real dots(real[2] p, real radius = 0.3) =
    1.0 - step(radius, length([fract(p[0]) - 0.5, fract(p[1]) - 0.5]));

/// Where in its brick a point lies, in [0, 1) along both axes: unit bricks, odd courses shifted by half.
/// >>> brick_position([0.25, 1.5])
/// [0.75, 0.5]
real[2] brick_position(real[2] p) = [fract(p[0] + 0.5 * (floor(p[1]) % 2.0)), fract(p[1])];

/// 1 on the bricks of `brick_position`, 0 in the mortar between them, which is `mortar` wide.
/// >>> brick([0.5, 0.5])
/// 1
real brick(real[2] p, real mortar = 0.08)
    q = brick_position(p);
    return pulse(0.5 * mortar, 1.0 - 0.5 * mortar, q[0])
        * pulse(0.5 * mortar, 1.0 - 0.5 * mortar, q[1]);

/// A number in [0, 1) for each brick.
/// >>> brick_tint([0.3, 0.2]) == brick_tint([0.6, 0.9])
/// true
real brick_tint(real[2] p) = cellnoise([p[0] + 0.5 * (floor(p[1]) % 2.0), p[1]]);

/// Growth rings of wood around the third axis, one a unit, wavy by `wobble`: 0 growing to 1 across each ring.
/// >>> rings([3.5, 0, 0], wobble = 0)
/// 0.5
real rings(real[3] p, real wobble = 0.2) = fract(length([p[0], p[1]]) + wobble * perlin(p));
