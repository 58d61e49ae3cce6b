// SPDX-License-Identifier: Apache-2.0
// Veins bent by six octaves of noise.
real marble(real[3] p) = 0.5 + 0.5 * sin(3.0 * p[0] + 4.0 * fbm(2.0 * p, 6));

const value = marble($object_position);
