// SPDX-License-Identifier: Apache-2.0
// Rings around the third axis, through a domain bent by noise.
real wood(real[3] p)
    q    = [p[0] + 0.3 * perlin(2.0 * p), p[1] + 0.3 * perlin(2.0 * p + 17.5), p[2]];
    ring = fract(9.0 * hypot(q[0], q[1]) + 0.4 * fbm(3.0 * q, 3));
    return mix(0.25, 0.75, smoothstep(0.3, 0.9, ring) * (1.0 - smoothstep(0.92, 1.0, ring)));

const value = wood($object_position);
