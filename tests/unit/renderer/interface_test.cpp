// SPDX-License-Identifier: Apache-2.0
// The queries of docs/renderer.md: cameras and lights as both ends of a path, and an integrator
// from the light written against them alone.
#include <doctest/doctest.h>

#include <cmath>

#include "base/hash.h"
#include "base/warp.h"
#include "renderer/accel.h"
#include "renderer/camera.h"
#include "renderer/lights.h"
#include "renderer/vertex.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr double kTwoPi = 2 * kPi<double>;

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

Camera camera_with(double aperture) {
  Camera c;
  c.position = {1, 2, 3};
  c.target = {0.2, -0.1, 0};
  c.fov = 0.9;
  c.aperture = aperture;
  c.focus = 2.5;
  return c;
}

}  // namespace

TEST_CASE(
    "what a camera senses is where its rays come from, and its density is one over the film") {
  for (const double aperture : {0.0, 0.3}) {
    CAPTURE(aperture);
    const CameraRays camera(camera_with(aperture), 40, 24);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const double x = 40 * u01(4 * i), y = 24 * u01(4 * i + 1);
      const CameraRay ray = camera.at(x, y, u01(4 * i + 2), u01(4 * i + 3));
      const auto s = camera.sense(Vec3d(ray.origin), normalize(Vec3d(ray.direction)));
      REQUIRE(s);
      // Origins and directions are floats: 2^-23 of a few metres, over a pixel of 0.04.
      CHECK(std::abs(s->x - x) < 1e-4);
      CHECK(std::abs(s->y - y) < 1e-4);
    }
    const auto lens = camera.sample_lens(0.3, 0.8);
    CHECK(lens.pdf == camera.pdf_lens());
    // Directions drawn evenly in the half space: their mean of pdf cos / (1 / 2 pi) is 1.
    const int n = kSanitized ? 20000 : 200000;
    double sum = 0, squares = 0;
    const Frame<double> axes = Frame<double>::around(camera.forward());
    for (int i = 0; i < n; ++i) {
      const double z = u01(2 * std::uint64_t(i)), phi = kTwoPi * u01(2 * std::uint64_t(i) + 1);
      const double r = std::sqrt(1 - z * z);
      const Vec3d d = axes.to_world({r * std::cos(phi), r * std::sin(phi), z});
      const auto s = camera.sense(lens.position, d);
      const double value = s ? s->pdf * z * kTwoPi : 0;
      sum += value;
      squares += value * value;
      if (s) CHECK(s->importance == doctest::Approx(s->pdf * 40 * 24));
    }
    const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
    CHECK(std::abs(mean - 1) < 4 * error);
    CHECK(error < 0.02);
  }
}

TEST_CASE("points of lights: densities are those of the choice, and integrate to one") {
  SceneData scene;
  scene.surfaces.emplace_back();
  const Disc disc{{0, 0, 0}, Frame<double>::around(Vec3d{0, 1, 0}), 0.5};
  for (const Shape& shape : {Shape(disc), Shape(Sphere{{3, 0, 0}, 0.2})}) {
    scene.objects.emplace_back();
    scene.objects.back().shape = shape;
  }
  const Lights lights(scene, {2.0, 5.0});
  CHECK(lights.pdf_point(0) * area(scene.objects[0].shape) +
            lights.pdf_point(1) * area(scene.objects[1].shape) ==
        doctest::Approx(1));
  int of_disc = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const EmissionPoint e =
        lights.sample_point(u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    of_disc += e.object == 0;
    CHECK(e.pdf == lights.pdf_point(e.object));
  }
  const double share = lights.pdf_point(0) * area(scene.objects[0].shape);
  CHECK(std::abs(double(of_disc) / n - share) < 4 * std::sqrt(share * (1 - share) / n));
}

namespace {

constexpr const char* kLitPatch = R"({
  "camera": {"position": [0, 1.2, 0.4], "target": [0, 0, 0], "fov": 60, "aperture": 0.02},
  "materials": {"lamp": {"matte": 0, "emission": 2}, "grey": {"matte": 0.6}},
  "objects": [
    {"quad": {"corner": [-2, 0, 2], "u": [4, 0, 0], "v": [0, 0, -4]}, "surface": "grey"},
    {"sphere": {"radius": 0.1, "center": [0.2, 0.3, 0]}, "surface": "grey"},
    {"disc": {"center": [0.3, 1.9, 0], "normal": [0, -1, 0], "radius": 0.4}, "surface": "lamp"},
    {"sphere": {"center": [-0.8, 1.7, 0], "radius": 0.1}, "surface": "lamp"}]})";

/// Light tracing, thesis 4.4.2's other half: from a point of a light in a direction that it
/// radiates to, to what is there, and on to the lens. Mean luminance over the film's pixels, and
/// its error.
Mean trace_from_lights(const SceneData& scene, const vm::Program& program, int side, int paths) {
  const Compiled compiled(program);
  const Accel accel(scene, std::vector<bool>(scene.objects.size(), false));
  std::vector<double> radiance;
  for (const Object& o : scene.objects)
    radiance.push_back(scene.surfaces[o.surface].fixed.emission[1]);
  const Lights lights(scene, radiance);
  const CameraRays camera(scene.camera, side, side);
  double sum = 0, squares = 0;
  for (int i = 0; i < paths; ++i) {
    const auto u = [&](std::uint64_t k) { return u01(16 * std::uint64_t(i) + k); };
    const Cluster cluster = sample_cluster(u(0));
    const EmissionPoint begin = lights.sample_point(u(1), u(2));
    // Cosine: the density per projected steradian is 1 / pi.
    const Frame<double> axes = Frame<double>::around(begin.surface.normal);
    const Vec3d out = axes.to_world(square_to_cosine_hemisphere(u(3), u(4)));
    const FixedSurface& lamp = scene.surfaces[scene.objects[begin.object].surface].fixed;
    Spectrumf carried =
        fixed_emission(lamp, begin.surface, out, cluster) * float(kPi<double> / begin.pdf);
    double value = 0;
    Crossings none;
    const Vec3f from = ray_origin(begin.surface, out);
    const Hit hit = accel.intersect(from, Vec3f(out), 0, 1e30f, none);
    if (hit.object >= 0) {
      const SurfacePoint at = surface_of(scene, hit, from, Vec3f(out));
      const Object& o = scene.objects[hit.object];
      carried *= fixed_albedo(scene.surfaces[o.surface].fixed, o, at.position, cluster) *
                 float(1 / kPi<double>);
      const CameraRays::LensPoint lens = camera.sample_lens(u(5), u(6));
      const Vec3d way = lens.position - at.position;
      const double d2 = dot(way, way);
      const Vec3d to = way / std::sqrt(d2);
      const double cosine = dot(to, at.normal), at_lens = -dot(to, camera.forward());
      const auto sensed = camera.sense(lens.position, -to);
      const Vec3f start = ray_origin(at, to);
      if (sensed && cosine > 0 && at_lens > 0 &&
          !accel.occluded(start, Vec3f(to), float(length(lens.position - Vec3d(start)))))
        value = cluster.xyz(carried * (1.0f / kWavelengths))[1] * cosine * at_lens / d2 *
                sensed->importance;
    }
    sum += value;
    squares += value * value;
  }
  const double mean = sum / paths, pixels = double(side) * side;
  return {mean / pixels, std::sqrt((squares / paths - mean * mean) / paths) / pixels};
}

}  // namespace

TEST_CASE("an integrator from the light, by the interface alone, agrees with path tracing") {
  HandProgram p;
  const Scene scene = scene_of(p.program, kLitPatch);
  RenderOptions o = options(16, kSanitized ? 32 : 256);
  o.max_depth = 1;
  const Mean path = mean_luminance(run(p.program, scene, o).film);
  const Mean light = trace_from_lights(scene.data(), p.program, 16, kSanitized ? 20000 : 400000);
  INFO("from the camera ", path.value, " +- ", path.error, ", from the light ", light.value, " +- ",
       light.error);
  CHECK(std::abs(path.value - light.value) < 4 * std::hypot(path.error, light.error));
  CHECK(light.error < (kSanitized ? 0.05 : 0.01) * light.value);
}
