// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What tests of rendered scenes share: scripts and scenes from text, small renders, and the test
/// of a picture's mean.

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hand_program.h"
#include "lang/link.h"
#include "lang/parser.h"
#include "renderer/scene.h"
#include "stdlib/stdlib.h"

namespace mms::renderer::test {

/// A linked script.
inline vm::Program compile(const std::string& text) {
  const lang::Library library{stdlib::builtins(), stdlib::modules()};
  lang::Diagnostics diagnostics;
  const lang::SourcePtr source = lang::make_source("t.mms", text);
  std::vector<lang::Graph> graphs;
  graphs.push_back(lang::parse(source, diagnostics));
  auto linked = lang::link(graphs, library, {}, diagnostics);
  REQUIRE_MESSAGE(linked.has_value(), lang::render(diagnostics));
  return std::move(linked->program);
}

inline Scene scene_of(const vm::Program& program, std::string_view text) {
  Result<SceneData> data = parse_scene(program, {}, text, "test", "");
  REQUIRE_MESSAGE(bool(data), (data ? "" : data.error().where + ": " + data.error().what));
  return Scene(std::make_shared<const SceneData>(std::move(*data)));
}

inline Scene builtin(const vm::Program& program, const std::string& name) {
  Result<Scene> s = load_scene(program, {name, "", ""});
  REQUIRE(bool(s));
  return *s;
}

inline RenderOptions options(int side, int samples, int threads = 2) {
  RenderOptions o;
  o.width = o.height = side;
  o.samples = samples;
  o.threads = threads;
  o.seed = 11;
  o.filter = FilterShape::Box;  // neighbours share no samples: the error of a mean is known
  return o;
}

inline Rendered run(const vm::Program& p, const Scene& s, const RenderOptions& o) {
  Result<Rendered> r = render(p, s, o);
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + ": " + r.error().what));
  CHECK(r->report.dropped.count() == 0);
  return std::move(*r);
}

/// Four standard errors: a false alarm in 16000 renders with other seeds; the seed is fixed.
inline void check_mean(const Film& film, double expected) {
  const Mean m = mean_luminance(film);
  INFO("mean ", m.value, " +- ", m.error, ", expected ", expected);
  CHECK(std::abs(m.value - expected) < 4 * m.error + 1e-6 * expected);
}

/// A patch of matte ground around the origin, seen from straight above: every path of one
/// scattering. `light` is more objects.
inline std::string patch(const std::string& light, const std::string& environment = "0") {
  return R"({"camera": {"position": [0, 1.2, 0], "target": [0, 0, 0], "up": [0, 0, -1], "fov": 0.01},
    "environment": {"constant": )" +
         environment + R"(},
    "materials": {"lamp": {"matte": 0, "emission": 2}},
    "objects": [{"quad": {"corner": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2]}, "test": true})" +
         light + "]}";
}

/// Matte ground around the origin, seen from straight above, a ball of the script's surface beside
/// it, and a disc that radiates 2 towards `facing`.
inline std::string ground_by_ball(Vec3d ball, double radius, Vec3d lamp, Vec3d facing,
                                  double lamp_radius) {
  return fmt::format(R"({{"camera": {{"position": [0, 1.2, 0], "target": [0, 0, 0],
      "up": [0, 0, -1], "fov": 0.01}},
      "materials": {{"lamp": {{"matte": 0, "emission": 2}}, "ground": {{"matte": 0.5}}}},
      "objects": [{{"quad": {{"corner": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2]}},
      "surface": "ground"}},
      {{"sphere": {{"center": [{}, {}, {}], "radius": {}}}, "test": true}},
      {{"disc": {{"center": [{}, {}, {}], "normal": [{}, {}, {}], "radius": {}}},
      "surface": "lamp"}}]}})",
                     ball.x, ball.y, ball.z, radius, lamp.x, lamp.y, lamp.z, facing.x, facing.y,
                     facing.z, lamp_radius);
}

}  // namespace mms::renderer::test
