// SPDX-License-Identifier: Apache-2.0
// Steps until z leaves the circle of radius 2, at most 128.
integer escape(real x, y, a, b, integer n)
    return select
        n, if n == 128 or x * x + y * y > 4.0;
        escape(x * x - y * y + a, 2.0 * x * y + b, a, b, n + 1) otherwise;
    end;

const value = real(escape(0.0, 0.0, 3.0 * $uv[0] - 2.2, 2.6 * $uv[1] - 1.3, 0)) / 128.0;
