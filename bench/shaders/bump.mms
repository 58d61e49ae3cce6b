// SPDX-License-Identifier: Apache-2.0
// The exact slope of four octaves of noise along the tangent and the bitangent.
surface bump
    height = 0.01 * fbm(6.0 * $object_position, 4);
end
