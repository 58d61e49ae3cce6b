// SPDX-License-Identifier: Apache-2.0
// Distance to the nearest of the random points in 27 cells.
const value = worley(4.0 * $object_position);
