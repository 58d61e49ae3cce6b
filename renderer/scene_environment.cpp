// SPDX-License-Identifier: Apache-2.0
// The environments that a scene file can write, and those that have a name: docs/scene.md.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "renderer/environments.h"
#include "renderer/picture.h"
#include "renderer/scene_node.h"
#include "renderer/sky.h"

namespace mms::renderer {
namespace {

EnvironmentImage picture(const Node& n, const std::string& path) {
  Result<EnvironmentImage> image = load_environment(path);
  if (!image) n.fail(image.error());
  return std::move(*image);
}

EnvironmentImage sky(const Node& n) {
  const std::string name = n["sky"].text();
  std::vector<std::string> known;
  for (const Sky& s : skies()) {
    known.emplace_back(s.name);
    if (s.name != name) continue;
    if (!n.has("sun")) return make_sky(s, kSun);
    if (!s.has_sun())
      n["sun"].fail(fmt::format("the sky `{}` does not depend on the sun", name),
                    "leave `sun` out");
    const Vec3d sun = n["sun"].direction();
    if (!(sun.y > 0)) n["sun"].fail("the sun is not above the horizon", "y is up");
    return make_sky(s, sun);
  }
  n["sky"].fail(fmt::format("no sky `{}`", name), hint_for(name, known));
}

}  // namespace

Environment parse_environment(const Node& n, const std::string& folder) {
  n.keys({"constant", "image", "sky", "sun", "scale", "rotate"});
  if (n.has("constant") + n.has("image") + n.has("sky") != 1)
    n.fail("an environment has one of `constant`, `image` and `sky`");
  if (n.has("sun") && !n.has("sky")) n["sun"].fail("`sun` belongs to an environment with `sky`");
  if (n.has("constant")) {
    if (n.has("scale") || n.has("rotate"))
      n.fail("`scale` and `rotate` belong to an environment with `image` or `sky`");
    return {n["constant"].rgb(1e9), {}};
  }
  const double scale = n.number_or("scale", 1, 0, 1e9);
  return {{scale, scale, scale},
          n.has("sky") ? sky(n) : picture(n["image"], in_folder(n["image"].text(), folder)),
          n.number_or("rotate", 0, -1e6, 1e6) * kDegree};
}

Environment environment_named(const std::string& name) {
  constexpr const char* kOption = "--environment";
  std::vector<std::string> known;
  for (const NamedEnvironment& e : kEnvironments) {
    known.emplace_back(e.name);
    if (e.name != name) continue;
    const Json json = Json::parse(e.text);
    return parse_environment(Node(json, kOption, ""), "");
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored))
    throw Mistake{no_such(kOption, "environment", name, known)};
  Result<EnvironmentImage> image = load_environment(name);
  if (!image) throw Mistake{image.error()};
  return {{1, 1, 1}, std::move(*image)};
}

Result<EnvironmentImage> load_environment(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return no_file("picture", path);
  Result<ReadPicture> picture = read_picture(path);
  if (!picture) return picture.error();
  for (std::array<float, 3>& c : picture->rgb)
    for (float& v : c) {
      if (!std::isfinite(v)) return Error{path, "a pixel of the picture is not finite", ""};
      v = std::max(0.0f, v);
    }
  return EnvironmentImage{path, picture->width, picture->height, std::move(picture->rgb)};
}

}  // namespace mms::renderer
