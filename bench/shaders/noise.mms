// SPDX-License-Identifier: Apache-2.0
// One call of three-dimensional gradient noise.
const value = perlin(4.0 * $object_position);
