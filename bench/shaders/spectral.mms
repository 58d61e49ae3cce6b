// SPDX-License-Identifier: Apache-2.0
// Two reflectances mixed, then darkened through an absorbing layer.
spectrum tinted(real t, depth) = mix(rgb(0.9, 0.6, 0.3), rgb(0.1, 0.3, 0.7), t) * exp(-depth * rgb(0.2, 0.9, 1.4));

const value = tinted($uv[0], 2.0 * $uv[1]);
