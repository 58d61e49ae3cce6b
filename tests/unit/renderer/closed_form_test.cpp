// SPDX-License-Identifier: Apache-2.0
// Scenes whose radiance is known from a formula: light transport from end to end, no oracle of
// ours.
#include <doctest/doctest.h>

#include <cmath>

#include "base/quadrature.h"
#include "base/warp.h"
#include "renderer/cluster.h"
#include "renderer/sampler.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr double kEven = 106.857 / 105.671;  ///< luminance of a spectrum of 1 (CIE 15, 1 nm rows)

int samples(int n) { return kSanitized ? std::max(1, n / 8) : n; }

/// A mean that was found from spectra of script numbers, whose luminance is known to 1e-5.
void check_even(const Film& film, double expected) { check_mean(film, expected * kEven); }

}  // namespace

TEST_CASE("inside a closed diffuse sphere, albedo 0.5 and emission 0.5, radiance is 1 everywhere") {
  const vm::Program p = compile(
      "surface s\n bsdf = matte(0.5); emission = 0.5; emission_function = translucent(1);\nend\n");
  const Scene s = scene_of(p, R"({"camera": {"position": [0.3, 0.1, 0.2], "target": [0, 0, -1],
    "fov": 90}, "objects": [{"sphere": {"radius": 1}, "test": true}]})");
  check_even(run(p, s, options(32, samples(64))).film, 1);
}

TEST_CASE("a homogeneous slab lets exp(-sigma d / cos) through, seen straight and at 60 degrees") {
  const vm::Program p = compile("volume v\n absorption = 0.8; scattering = 0;\nend\n");
  for (const double angle : {0.0, 60.0}) {
    CAPTURE(angle);
    const double a = angle * kPi<double> / 180;
    const std::string at = fmt::format("[{}, 0, {}]", 5 * std::sin(a), 5 * std::cos(a));
    const Scene s = scene_of(p, R"({"camera": {"target": [0, 0, 0], "fov": 0.01, "position": )" +
                                    at + R"(}, "environment": {"constant": 1},
      "objects": [{"box": {"size": [40, 40, 1.5]}, "test": true}]})");
    check_mean(run(p, s, options(8, 64)).film, std::exp(-0.8 * 1.5 / std::cos(a)));
  }
}

TEST_CASE(
    "a slab that scatters lets exp(-sigma d) past unscattered: the rest is lost to no depth") {
  // One scattering is allowed and its phase function has weight 0: what is left went straight on.
  const vm::Program p = compile(
      "volume v\n scattering = 0.9; absorption = 0.3; phase = henyey_greenstein(0.3) * 0;\nend\n");
  const Scene s = scene_of(p, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0],
    "fov": 0.01}, "environment": {"constant": 1}, "objects": [{"box": {"size": [40, 40, 1.5]},
    "test": true}]})");
  check_mean(run(p, s, options(16, 64)).film, std::exp(-1.2 * 1.5));
}

TEST_CASE("single scattering in a slab: sigma_s E p (1 - exp(-sigma d (1 + 1/c))) / (1 + 1/c)") {
  // A far lamp of solid angle `omega` at 60 degrees on the camera's side lights a slab; the path
  // ends after one scattering. In: s along the view, out: s / cos 60 along the light.
  std::string phase = "isotropic()";
  double g = 0;
  SUBCASE("isotropic") {}
  SUBCASE("Henyey-Greenstein, forwards") {
    g = 0.5;
    phase = "henyey_greenstein(0.5)";
  }
  SUBCASE("Henyey-Greenstein, backwards") {
    g = -0.5;
    phase = "henyey_greenstein(-0.5)";
  }
  std::string absorption = "0.1";
  SUBCASE("by tentative collisions") { absorption = "0.1 + 0 * $position.x"; }
  const vm::Program p = compile("volume v\n scattering = 0.4; absorption = " + absorption +
                                "; phase = " + phase + ";\nend\n");
  const double c = 0.5, far = 1000, radius = 20, d = 1.5, sigma = 0.5;
  const Scene s = scene_of(
      p, fmt::format(R"({{"camera": {{"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01}},
    "materials": {{"lamp": {{"matte": 0, "emission": 1000}}}},
    "objects": [{{"box": {{"size": [400, 400, 1.5]}}, "test": true}},
    {{"disc": {{"center": [{0}, 0, {1}], "normal": [{2}, 0, {3}], "radius": {4}}},
      "surface": "lamp"}}]}})",
                     far * std::sqrt(0.75), far * c, -std::sqrt(0.75), -c, radius));
  RenderOptions o = options(32, kSanitized ? 64 : 256);
  o.max_depth = 1;
  const Rendered r = run(p, s, o);
  const double omega = kPi<double> * radius * radius / (far * far);
  // Light travels along (-sin, 0, -cos), and leaves towards the camera, (0, 0, 1).
  const double mean_cosine = -c;
  const double density =
      (1 - g * g) / (4 * kPi<double> * std::pow(1 + g * g - 2 * g * mean_cosine, 1.5));
  const double both = sigma * (1 + 1 / c);
  const double expected = 0.4 * density * 1000 * omega * (1 - std::exp(-both * d)) / both;
  const Mean m = mean_luminance(r.film);
  INFO("mean ", m.value, " +- ", m.error, ", expected ", expected);
  // The lamp is 0.02 rad wide: its mean direction and cosine err by its square, 4e-4 relative.
  CHECK(std::abs(m.value - expected) < 4 * m.error + 1e-3 * expected);
  CHECK(m.error < 0.01 * expected);
}

TEST_CASE("a thin medium is as bright as single scattering says, but for the square of its depth") {
  const vm::Program p = compile("volume v\n scattering = 0.01;\nend\n");
  // Optical depth 0.01 in even light all around, before a black wall: sigma d to first order.
  const Scene s = scene_of(p, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0],
    "fov": 0.01}, "environment": {"constant": 1}, "materials": {"black": {"matte": 0}},
    "objects": [{"box": {"size": [400, 400, 1]}, "test": true},
    {"quad": {"corner": [-400, -400, -0.75], "u": [800, 0, 0], "v": [0, 800, 0]},
     "surface": "black"}]})");
  RenderOptions o = options(32, samples(256));
  const Mean m = mean_luminance(run(p, s, o).film);
  // Of what is scattered half comes from the bright side, dimmed along 1 / cos: the exponential
  // integral. Quadrature of one scattering over depth and direction; two are of order tau^2 ln tau.
  const double single = integrate_adaptive(
      [](double z) {
        return 0.01 * std::exp(-0.01 * z) * 0.5 *
               integrate_adaptive([&](double mu) { return std::exp(-0.01 * z / mu); }, 1e-6, 1.0,
                                  1e-9);
      },
      0, 1, 1e-9);
  INFO("mean ", m.value, " +- ", m.error, ", single ", single);
  CHECK(std::abs(m.value - single) < 4 * m.error + 0.05 * single);
  CHECK(m.error < (kSanitized ? 0.15 : 0.05) * single);
}

TEST_CASE("direct light of a quad: the configuration factor of a rectangle over its corner") {
  // E / (pi L) = (1 / 2 pi) (a / A atan(b / A) + b / B atan(a / B)), A^2 = 1 + a^2, B^2 = 1 + b^2;
  // a and b are the edges over the height.
  const double a = 1.5, b = 0.75, A = std::hypot(1, a), B = std::hypot(1, b);
  const double factor = (a / A * std::atan(b / A) + b / B * std::atan(a / B)) / (2 * kPi<double>);
  HandProgram h;
  h.matte("ground", 0.6);
  std::string light;
  SUBCASE("a quad") {
    light = R"(,{"quad": {"corner": [0, 2, 0], "u": [3, 0, 0], "v": [0, 0, 1.5]},
              "surface": "lamp"})";
  }
  SUBCASE("two triangles of a mesh") {
    light = R"(,{"mesh": {"positions": [[0, 2, 0], [3, 2, 0], [3, 2, 1.5], [0, 2, 1.5]],
              "triangles": [[0, 1, 2], [0, 2, 3]]}, "surface": "lamp"})";
  }
  SUBCASE("the lower face of a box") {
    light = R"(,{"box": {"center": [1.5, 2.25, 0.75], "size": [3, 0.5, 1.5]}, "surface": "lamp"})";
  }
  const Rendered r = run(h.program, scene_of(h.program, patch(light)), options(32, samples(128)));
  // The box shows two thin sides as well, from straight below the edge: none of their light.
  check_mean(r.film, 0.6 * 2 * factor);
}

TEST_CASE("direct light of a sphere that the horizon cuts: E = pi L times the known factor") {
  // Element and sphere's centre at angle w between arccos-limits: with h = d / r and the normal at
  // 90 degrees to the centre, factor = (1 / pi) (asin(1/h) - sqrt(h^2 - 1) / h^2).
  HandProgram h;
  h.matte("ground", 0.6);
  const double d = 2, radius = 1, ratio = d / radius;
  const double factor =
      (std::asin(1 / ratio) - std::sqrt(ratio * ratio - 1) / (ratio * ratio)) / kPi<double>;
  const Rendered r = run(h.program, scene_of(h.program, patch(R"(,{"sphere": {"center": [2, 0, 0],
      "radius": 1}, "surface": "lamp"})")),
                         options(32, samples(256)));
  check_mean(r.film, 0.6 * 2 * factor);
}

TEST_CASE("a prism turns light by its index: the angle of the path's own wavelength") {
  // An equilateral prism, its edge along y. Where the path leaves the scene is read from a picture
  // whose grey grows evenly with the azimuth, over the same path in even light: past polished
  // surfaces that disperse only the hero goes on, so the ratio is its own, free of all weights. The
  // faces reflect nothing, since a path would follow that as well.
  const vm::Program p = compile(
      "surface s\n bsdf = dielectric(1.6 + 12e-15 / ($wavelength * $wavelength), 0, 0);\nend\n");
  const int width = 512;
  EnvironmentImage ramp{"", width, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < width; ++x)
      ramp.rgb.push_back({float(x) + 0.5f, float(x) + 0.5f, float(x) + 0.5f});
  // The view runs along -z, meets one face at 50 degrees, and leaves by the next.
  const double incidence = 50;
  const std::string scene = fmt::format(
      R"({{"camera": {{"position": [0, 0, 50], "target": [0, 0, 0], "fov": 0.01}},
    "environment": {{"constant": 1}}, "objects": [{{"test": true, "rotate": [0, {}, 0], "mesh": {{
    "positions": [[0, -9, 1.1547], [1, -9, -0.57735], [-1, -9, -0.57735],
                  [0, 9, 1.1547], [1, 9, -0.57735], [-1, 9, -0.57735]],
    "triangles": [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5],
                  [0, 2, 1], [3, 4, 5]]}}}}]}})",
      -(60 - incidence));
  Result<SceneData> even = parse_scene(p, {}, scene, "even", "");
  REQUIRE_MESSAGE(bool(even), (even ? "" : even.error().what));
  SceneData graded = *even;
  graded.environment.image = ramp;
  const int side = kSanitized ? 64 : 256;
  RenderOptions o = options(side, 1);
  const Film flat = run(p, Scene(std::make_shared<const SceneData>(*even)), o).film;
  const Film seen = run(p, Scene(std::make_shared<const SceneData>(graded)), o).film;

  const auto index = [](double nm) { return 1.6 + 12e3 / (nm * nm); };
  /// Deviation by Snell's law twice: i + out - 60 degrees.
  const auto deviation = [&](double nm) {
    const double n = index(nm), edge = kPi<double> / 3, i = incidence * kPi<double> / 180;
    const double inside = std::asin(std::sin(i) / n);
    return i + std::asin(n * std::sin(edge - inside)) - edge;
  };
  for (const double line : {435.8, 486.1, 546.1, 587.6, 656.3}) {
    CAPTURE(line);
    int met = 0, near = 0;
    for (int i = 0; i < side * side; ++i) {
      const double nm =
          sample_wavelengths(cluster_number(Sampler(o.seed, i % side, i / side, 0)(kWavelength)))
              .nm[0];
      if (std::abs(nm - line) > 4) continue;
      ++near;
      if (!(flat.xyz[i][1] > 0)) continue;
      const double column = seen.xyz[i][1] / flat.xyz[i][1];  // grey is the column, from 0 on
      const double azimuth = (column / width - 0.5) * 2 * kPi<double>;
      // The view spans 9e-5 rad each way, and floats of the ray err by 1e-6.
      met += std::abs(std::abs(azimuth) - deviation(nm)) < 3e-4;
    }
    CHECK(near > 5);
    CHECK(met > 0.99 * near);
  }
  CHECK(deviation(435.8) - deviation(656.3) > 0.05);  // the lines are far apart in this measure
}
