// SPDX-License-Identifier: Apache-2.0
// A bilinear gradient with a curve over it: 12 floating-point operations.
real gradient(real u, v)
    near = 0.1 + 0.8 * u;
    far  = 0.9 - 0.3 * u;
    t    = near + (far - near) * v;
    return t * (1.5 - 0.5 * t) + 0.25 * u * v;

const value = gradient($uv[0], $uv[1]);
