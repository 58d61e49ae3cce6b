// SPDX-License-Identifier: Apache-2.0
// Two shades on unit squares, each with a slope.
real squares(real u, v)
    odd = (floor(8.0 * u) + floor(8.0 * v)) % 2.0;
    return select 0.9 - 0.2 * u, if odd == 0.0; 0.1 + 0.2 * v otherwise end;

const value = squares($uv[0], $uv[1]);
