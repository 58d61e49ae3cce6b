// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `height` as geometry: spheres and meshes cut into small triangles, whose corners a script moves
/// along the normal.

#include "base/result.h"
#include "renderer/camera.h"
#include "renderer/scripts.h"

namespace mms::renderer {

/// Triangles of one object at most.
inline constexpr std::size_t kMostMicrotriangles = 8'000'000;

/// The scene with a mesh in place of each object that asks for displacement and wears a script with
/// a `height`. Edges in pixels are as `camera` sees them where the displaced object is nearest,
/// before `height` stretches them. Errors: more than kMostMicrotriangles; a camera so near that
/// pixels have no size. A script that does not come to an end counts as a height of 0 here, and is
/// told by `probe`.
Result<SceneData> displaced(const SceneData& scene, const Compiled& compiled,
                            const CameraRays& camera);

/// Whether some object is to be displaced.
bool any_displaced(const SceneData& scene);

}  // namespace mms::renderer
