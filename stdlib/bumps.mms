// SPDX-License-Identifier: Apache-2.0
// Bumps of a part of a material, below a smooth coat, say; the output `height` bends all of a surface.

/// How `height`, in metres along the normal, rises along `$tangent` and along `$bitangent`, by the
/// exact differentiation that finds the gradient of the output `height`.
/// >>> slope($time)
/// [0, 0]
real[2] slope(real height) = intrinsic::slope(height);

/// The same from a normal map: of a normal of any length along `$tangent`, `$bitangent` and the
/// surface's normal, such as 2 colour - 1 of a picture's colour.
/// >>> normal_slope([0.0, 0.6, 0.8])
/// [0, -0.75]
real[2] normal_slope(real[3] normal)
    up = max(normal.z, 1e-3);
    return [-normal.x / up, -normal.y / up];

/// `a` about the normal of bumps that rise so.
/// >>> tilt(matte(0.5), normal_slope([0.0, 0.6, 0.8]))
material tilt(material a, real[2] slope) = tilt(a, slope[0], slope[1]);

/// `a` with bumps of its own: `height` in metres along the normal, as the output of that name.
/// >>> bumped(matte(0.5), 0.001 * perlin(200 * $object_position))
material bumped(material a, real height) = tilt(a, slope(height));
