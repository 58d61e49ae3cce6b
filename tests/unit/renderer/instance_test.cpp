// SPDX-License-Identifier: Apache-2.0
// Meshes that are there several times: rays meet one, moved, as they would meet each.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "base/hash.h"
#include "renderer/accel.h"
#include "scenes.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr const char* kOctahedra = R"({
  "camera": {"position": [1000, 3, 40], "target": [1000, 3, 2], "fov": 6},
  "environment": {"constant": 1},
  "materials": {"grey": {"matte": 0.5}},
  "objects": [
    {"name": "first", "surface": "grey", "translate": [50, 0, 0], "rotate": [10, 20, 30], "mesh": {
      "positions": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
      "triangles": [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                    [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]}},
    {"instance": "first", "surface": "grey", "translate": [1000, 3, 2], "scale": 7,
     "rotate": [200, 15, 70]},
    {"instance": "first", "surface": "grey", "translate": [1, -2, 3], "scale": 0.01}]})";

}  // namespace

TEST_CASE("rays meet instances where they would meet meshes of their own") {
  HandProgram p;
  const SceneData shared = scene_of(p.program, kOctahedra).data();
  SceneData own = shared;
  for (Object& o : own.objects) o.instance_of = -1;
  CHECK(shared.objects[1].instance_of == 0);
  CHECK(shared.objects[1].slack > 0);
  for (const bool collect : {false, true}) {
    CAPTURE(collect);
    const std::vector<bool> collected{false, collect, false};
    const Accel a(shared, collected), b(own, collected);
    int met = 0, differ = 0;
    for (std::uint64_t i = 0; i < 6000; ++i) {
      const auto u = [&](std::uint64_t k) { return to_unit(mix64(8 * i + k)); };
      const Object& target = shared.objects[i % 3];
      const double size = target.transform.scale;
      const auto near = [&](std::uint64_t k, double reach) {
        return target.transform.move +
               Vec3d{u(k) - 0.5, u(k + 1) - 0.5, u(k + 2) - 0.5} * (2 * reach * size);
      };
      const Vec3d from = near(0, 4);
      const Vec3f o(from), d(normalize(near(3, 0.6) - from));
      Crossings ca, cb;
      const Hit ha = a.intersect(o, d, 0, 1e30f, ca), hb = b.intersect(o, d, 0, 1e30f, cb);
      met += hb.object >= 0 || cb.count > 0;
      // At an edge one may pass what the other meets.
      if (ha.object != hb.object || ha.primitive != hb.primitive || ca.count != cb.count) {
        ++differ;
        continue;
      }
      // No farther off the face than an instance is said to be, and than t itself is rounded.
      const auto same = [&](const Hit& x, const Hit& y) {
        const SurfacePoint at = surface_of(shared, x, o, d);
        const double off = std::abs((x.t - y.t) * dot(at.geometric_normal, Vec3d(d)));
        return x.object == y.object && off <= at.error + 2 * 0x1p-24 * x.t;
      };
      if (hb.object >= 0) CHECK(same(ha, hb));
      for (int k = 0; k < cb.count; ++k) CHECK(same(ca.hits[k], cb.hits[k]));
      CHECK(a.occluded(o, d, 1e30f) == (ha.object >= 0));
    }
    CHECK(met > 3000);
    CHECK(differ < 12);
  }
}

TEST_CASE(
    "rays that leave an instance do not meet it again: a convex one in even light is as bright as "
    "it reflects") {
  HandProgram p;
  const Scene s = scene_of(p.program, kOctahedra);
  check_mean(run(p.program, s, options(16, 16)).film, 0.5);
}
