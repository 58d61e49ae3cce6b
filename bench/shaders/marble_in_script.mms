// SPDX-License-Identifier: Apache-2.0
// The marble, with its noise written in the language: arithmetic hash, random slopes at the corners.
integer scramble(integer i, j, k)
    h = i * 73856093 + j * 19349663 + k * 83492791;
    return h * (h * h * 15731 + 789221) + 1376312589;

real corner(integer h, real x, y, z)
    i = h * 1664525 + 1013904223;
    j = i * 1664525 + 1013904223;
    return 4.656612873077393e-10 * (real(h) * x + real(i) * y + real(j) * z);

real fade(real t) = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);

real slopes(real[3] p)
    fx = floor(p[0]); fy = floor(p[1]); fz = floor(p[2]);
    i = integer(fx); j = integer(fy); k = integer(fz);
    x = p[0] - fx; y = p[1] - fy; z = p[2] - fz;
    u = fade(x); v = fade(y); w = fade(z);
    near = mix(mix(corner(scramble(i, j, k), x, y, z),
                   corner(scramble(i + 1, j, k), x - 1.0, y, z), u),
               mix(corner(scramble(i, j + 1, k), x, y - 1.0, z),
                   corner(scramble(i + 1, j + 1, k), x - 1.0, y - 1.0, z), u), v);
    far  = mix(mix(corner(scramble(i, j, k + 1), x, y, z - 1.0),
                   corner(scramble(i + 1, j, k + 1), x - 1.0, y, z - 1.0), u),
               mix(corner(scramble(i, j + 1, k + 1), x, y - 1.0, z - 1.0),
                   corner(scramble(i + 1, j + 1, k + 1), x - 1.0, y - 1.0, z - 1.0), u), v);
    return mix(near, far, w);

real octaves(real[3] p, integer left, real amplitude, total)
    return select
        total, if left == 0;
        octaves(2.0 * p, left - 1, 0.5 * amplitude, total + amplitude * slopes(p)) otherwise;
    end;

const value = 0.5 + 0.5 * sin(3.0 * $object_position[0] + 4.0 * octaves(2.0 * $object_position, 6, 1.0, 0.0));
