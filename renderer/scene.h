// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A scene as the renderer sees it: objects bound to descriptors, camera, environment. Made by
/// `load_scene`, checked, and not changed after that.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "renderer/render.h"
#include "renderer/shape.h"
#include "vm/program.h"

namespace mms::renderer {

/// Linear sRGB; as a reflectance or, times illuminant D65, as a light (thesis 6.1.3).
using Rgb = std::array<double, 3>;

/// A surface that the scene itself describes: no script runs for it.
struct FixedSurface {
  Rgb matte{0.5, 0.5, 0.5};
  std::optional<Rgb> checker;  ///< the other colour of a checkerboard over the object's x and z
  double checker_size = 0.25;  ///< edge of a field, m in object space
  Rgb emission{0, 0, 0};       ///< radiance in units of D65 = 1 W m^-2 sr^-1 nm^-1 at 560 nm
  bool invisible = false;      ///< scatters nothing: only bounds a volume

  bool emits() const { return emission != Rgb{0, 0, 0}; }
};

struct Surface {
  std::string name;
  const vm::Descriptor* script = nullptr;  ///< else `fixed`
  FixedSurface fixed;
};

struct Volume {
  std::string name;
  const vm::Descriptor* script = nullptr;
};

struct Object {
  std::string name;
  Shape shape;
  Transform transform;   ///< object space to world; the shape is in world space already
  int surface = 0;       ///< index into SceneData::surfaces
  int instance_of = -1;  ///< an earlier object that is the same mesh before the transforms, or none
  double slack = 0;      ///< how much farther off than `shape` a ray may find an instance, m
  int volume = -1;       ///< index into SceneData::volumes, or none
  bool test = false;     ///< an object under test
  int priority = 0;      ///< over what overlaps it (renderer/media.h); 0: none
  double displace = 0;   ///< edge of the triangles that `height` moves, m; 0: it bumps only
  double displace_pixels = 0;  ///< or the edge where it is nearest to the camera, in pixels
  bool displaced = false;      ///< `shape` has been moved by `height` already
  bool to_displace() const { return displace > 0 || displace_pixels > 0; }
};

struct Camera {
  Vec3d position{0, 0, 5}, target, up{0, 1, 0};
  double fov = 0.6;     ///< full vertical angle of view, radians
  double aperture = 0;  ///< radius of the lens, m; 0 is a pinhole
  double focus = 5;     ///< distance of the plane in focus, above 0; m
};

/// Latitude-longitude picture around the scene: +y up, the middle column looks along -z.
struct EnvironmentImage {
  std::string path;
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> rgb;
};

struct Environment {
  Rgb radiance{0, 0, 0};  ///< constant; for an image what its texels are multiplied by
  std::optional<EnvironmentImage> image;
  double rotation = 0;  ///< about +y, radians
};

struct SceneData {
  std::string name;
  std::vector<Surface> surfaces;
  std::vector<Volume> volumes;
  std::vector<Object> objects;
  Camera camera;
  Environment environment;
  std::string test_surface, test_volume;  ///< descriptors bound to the test object
  std::uint64_t hash = 0;  ///< of all that is seen but for the scripts; made by `load_scene`

  Bounds scene_bounds() const;
};

/// Text of a built-in scene, or nothing.
std::optional<std::string> builtin_scene_text(std::string_view name);

/// A scene from text; `origin` names it in messages, relative files are looked up in `folder`.
Result<SceneData> parse_scene(const vm::Program& program, const SceneSource& source,
                              std::string_view text, const std::string& origin,
                              const std::string& folder);

/// Triangles of an OBJ or PLY file, transformed. Errors: unreadable, no triangle, coordinates that
/// are not finite.
Result<Mesh> load_mesh(const std::string& path, const Transform& transform);

/// Linear RGB of a picture that OpenImageIO reads; sRGB formats are linearised.
Result<EnvironmentImage> load_environment(const std::string& path);

}  // namespace mms::renderer
