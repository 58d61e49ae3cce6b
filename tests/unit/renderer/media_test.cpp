// SPDX-License-Identifier: Apache-2.0
// Objects that overlap: volumes that add, and priorities. Against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "renderer/media.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// Two volumes, even or such that every place is asked for; what they scatter is lost, so that a
/// picture shows what came straight through.
std::string two_volumes(bool a_varies, bool b_varies) {
  const auto volume = [](const char* name, const char* scattering, const char* absorption,
                         bool varies) {
    return fmt::format(
        "volume {}\n scattering = {}; absorption = {}{}; phase = isotropic() * 0;\nend\n", name,
        scattering, absorption, varies ? " + 0 * $position.x" : "");
  };
  return volume("a", "0.2", "0.3", a_varies) + volume("b", "0.1", "0.6", b_varies);
}

/// Along z at (0, 0): `a` fills [-1, 1] and `b` [-0.3, 0.7], seen through a pinhole at `z`.
std::string two_boxes(double z, const char* a = "", const char* b = "") {
  return fmt::format(
      R"({{"camera": {{"position": [0, 0, {}], "target": [0, 0, -9], "fov": 0.01}},
    "environment": {{"constant": 1}}, "objects": [
    {{"box": {{"size": [40, 40, 2]}}, "volume": "a"{}}},
    {{"box": {{"size": [40, 40, 1], "center": [0, 0, 0.2]}}, "volume": "b"{}}}]}})",
      z, a, b);
}

double reflectance(double n1, double n2) {
  const double r = (n1 - n2) / (n1 + n2);
  return r * r;
}

/// Of clear interfaces one behind the other, light going back and forth between them without
/// interference: (1 - T) / T adds.
double stack(std::initializer_list<double> reflectances) {
  double sum = 0;
  for (double r : reflectances) sum += r / (1 - r);
  return 1 / (1 + sum);
}

constexpr const char* kGlassAndWater =
    "surface glass\n bsdf = dielectric(1.5);\nend\nsurface water\n bsdf = dielectric(1.33);\nend\n";

}  // namespace

TEST_CASE("volumes that overlap add their coefficients, even ones and such that vary") {
  for (const bool a : {false, true})
    for (const bool b : {false, true}) {
      CAPTURE(a);
      CAPTURE(b);
      const vm::Program p = compile(two_volumes(a, b));
      const Film film = run(p, scene_of(p, two_boxes(5)), options(16, 64)).film;
      check_mean(film, std::exp(-0.5 * 2 - 0.7 * 1));
    }
}

TEST_CASE("a camera inside of overlapping volumes looks out through what is before it only") {
  for (const bool varies : {false, true}) {
    CAPTURE(varies);
    const vm::Program p = compile(two_volumes(varies, !varies));
    const Film film = run(p, scene_of(p, two_boxes(0.5)), options(16, 64)).film;
    check_mean(film, std::exp(-0.5 * 1.5 - 0.7 * 0.8));
  }
}

TEST_CASE("a camera inside of an emitting medium sees e (1 - exp(-a d)) / a of both that overlap") {
  for (const char* place : {"", " + 0 * $position.x"}) {
    CAPTURE(place);
    const vm::Program p =
        compile(fmt::format("volume a\n absorption = 0.8{0}; emission = 0.3{0};\nend\n"
                            "volume b\n absorption = 0.4; emission = 0.5;\nend\n",
                            place));
    const Scene s = scene_of(p, R"({"camera": {"position": [0, 0, 0], "target": [0, 0, -1]},
      "objects": [{"sphere": {}, "volume": "a"}, {"sphere": {}, "volume": "b"}]})");
    // As bright as 1 W m^-2 sr^-1 nm^-1 at all wavelengths is: CIE 15, as in closed_form_test.
    const double even = 106.857 / 105.671;
    check_mean(run(p, s, options(16, 64)).film, even * 0.8 * (1 - std::exp(-1.2)) / 1.2);
  }
}

TEST_CASE("furnace: overlapping clouds of different colours and phase functions vanish") {
  std::string place;
  SUBCASE("in closed form") {}
  SUBCASE("one by tentative collisions") { place = " * (1 + 0.5 * perlin($position))"; }
  const vm::Program p = compile(
      "volume a\n scattering = rgb(0.3, 0.9, 1.5); phase = henyey_greenstein(0.6);\nend\n"
      "volume b\n scattering = rgb(1.2, 0.5, 0.2)" +
      place + ";\nend\n");
  const Scene s = scene_of(p, R"({"environment": {"constant": 1}, "objects": [
    {"sphere": {}, "volume": "a"}, {"sphere": {"center": [0.3, 0.2, 0.4]}, "volume": "b"}]})");
  const Film film = run(p, s, options(24, 32)).film;
  check_mean(film, 1);
}

TEST_CASE("strongly coloured media: tentative collisions scatter as the closed form does") {
  const auto see = [](const char* place) {
    const vm::Program p = compile(fmt::format(
        "volume a\n scattering = rgb(0.3, 1.5, 5){0}; absorption = rgb(1.5, 0.4, 0.05){0};\n"
        " phase = henyey_greenstein(0.7); bound = 12;\nend\n",
        place));
    const Scene s = scene_of(p, R"({"environment": {"constant": 0.2},
      "materials": {"lamp": {"matte": 0, "emission": 3}}, "objects": [{"sphere": {}, "test": true},
      {"disc": {"center": [0, 4, 3], "normal": [0, -4, -3], "radius": 2}, "surface": "lamp"}]})");
    return run(p, s, options(24, kSanitized ? 16 : 128)).film;
  };
  const Film even = see(""), varied = see(" + 0 * $position.x");
  const Mean a = mean_luminance(even), b = mean_luminance(varied);
  INFO(a.value, " +- ", a.error, ", ", b.value, " +- ", b.error);
  CHECK(std::abs(a.value - b.value) < 4 * std::hypot(a.error, b.error));
  CHECK(b.error < (kSanitized ? 0.05 : 0.01) * b.value);
  // Colours too: X and Z, whose errors show in the pixels, which differ by chance alone.
  for (const std::size_t k : {0, 2}) {
    double difference = 0, squares = 0;
    for (std::size_t i = 0; i < even.xyz.size(); ++i) {
      const double d = even.xyz[i][k] - varied.xyz[i][k];
      difference += d, squares += d * d;
    }
    CHECK(std::abs(difference) < 4 * std::sqrt(squares));
  }
}

TEST_CASE("openpbr: a deep body sends back its subsurface_color") {
  // A ball of 500 mean free paths in even light; the fit of colours is good to 0.005 (Kulla and
  // Conty 2017).
  for (const double colour : {0.2, 0.5, 0.8}) {
    const vm::Program p = compile(fmt::format(
        "surface s bsdf = openpbr(subsurface_weight = 1.0, specular_weight = 0.0); end\n"
        "volume s\n"
        "  inside = openpbr_inside(subsurface_weight = 1.0, subsurface_color = {}, "
        "subsurface_radius = 0.002, subsurface_radius_scale = 1.0);\n"
        "  scattering = inside.scattering; absorption = inside.absorption;\n"
        "end\n",
        colour));
    RenderOptions o = options(16, kSanitized ? 4 : 128);
    o.max_depth = 2000;
    const Scene ball = scene_of(p, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0],
      "fov": 10}, "environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})");
    const Mean seen = mean_luminance(run(p, ball, o).film);
    CHECK_MESSAGE(std::abs(seen.value - colour) < 4 * seen.error + 0.005, seen.value);
  }
}

TEST_CASE("a higher priority takes the place of a lower volume") {
  for (const bool varies : {false, true}) {
    CAPTURE(varies);
    const vm::Program p = compile(two_volumes(varies, false));
    const auto see = [&](double z, const char* a, const char* b) {
      return run(p, scene_of(p, two_boxes(z, a, b)), options(16, 64)).film;
    };
    constexpr const char *kOne = R"(, "priority": 1)", *kTwo = R"(, "priority": 2)";
    check_mean(see(5, kOne, kTwo), std::exp(-0.5 * 1 - 0.7 * 1));
    check_mean(see(5, "", kTwo), std::exp(-0.5 * 1 - 0.7 * 1));
    check_mean(see(5, kTwo, kOne), std::exp(-0.5 * 2));
    check_mean(see(5, kOne, kOne), std::exp(-0.5 * 2 - 0.7 * 1));
    check_mean(see(0.5, kOne, kTwo), std::exp(-0.5 * 0.7 - 0.7 * 0.8));
  }
}

TEST_CASE("what is opaque stays where it is in an object of priority: a fly in amber") {
  const vm::Program p = compile("volume a\n absorption = 0.5;\nend\n");
  const Scene s = scene_of(p, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0],
    "fov": 0.01}, "materials": {"lamp": {"matte": 0, "emission": 1}}, "objects": [
    {"box": {"size": [4, 4, 2]}, "volume": "a", "priority": 1},
    {"disc": {"normal": [0, 0, 1]}, "surface": "lamp"}]})");
  check_mean(run(p, s, options(8, 64)).film, std::exp(-0.5));
}

TEST_CASE("nested dielectrics: the index of each face is over what lies behind it") {
  const vm::Program p = compile(kGlassAndWater);
  // From the camera: water [0.5, 2], then glass [-1, 0.6] that reaches into it, before a lamp.
  const auto see = [&](double z, int water, int glass) {
    const Scene s =
        scene_of(p, fmt::format(R"({{"camera": {{"position": [0, 0, {}], "target": [0, 0, -9],
      "fov": 0.01}}, "materials": {{"lamp": {{"matte": 0, "emission": 1}}}}, "objects": [
      {{"box": {{"size": [40, 40, 1.5], "center": [0, 0, 1.25]}}, "surface": "water",
        "priority": {}}},
      {{"box": {{"size": [40, 40, 1.6], "center": [0, 0, -0.2]}}, "surface": "glass",
        "priority": {}}},
      {{"quad": {{"corner": [-20, -20, -2], "u": [40, 0, 0], "v": [0, 40, 0]}},
        "surface": "lamp"}}]}})",
                                z, water, glass));
    return run(p, s, options(16, 64)).film;
  };
  const double air_water = reflectance(1, 1.33), water_glass = reflectance(1.33, 1.5),
               air_glass = reflectance(1, 1.5);
  check_mean(see(5, 1, 2), stack({air_water, water_glass, air_glass}));
  check_mean(see(5, 2, 1), stack({air_water, water_glass, air_glass}));
  // Equal ones stay as their scripts say: over air, all four.
  check_mean(see(5, 0, 0), stack({air_water, air_glass, air_water, air_glass}));
  // From within the water: radiance is there 1.33^2 times what it is in air, and what the glass
  // sends back may return from the face behind the camera.
  const double through = stack({water_glass, air_glass});
  check_mean(see(1.5, 1, 2), 1.33 * 1.33 * through / (1 - (1 - through) * air_water));
}

TEST_CASE("an object with a priority that emits is refused") {
  const vm::Program p = compile("surface s\n emission = 1;\nend\n");
  const Scene s = scene_of(p, R"({"objects": [{"sphere": {}, "test": true, "priority": 1}]})");
  const Result<Rendered> r = render(p, s, options(8, 1));
  REQUIRE(!r);
  CHECK(r.error().what == "an object with a `priority` emits light");
}

TEST_CASE("leaving takes the object away wherever it stands, and only if it is there") {
  Media m;
  for (int object : {4, 7, 4}) m.enter(object);
  m.leave(9);
  CHECK(m.count == 3);
  m.leave(4);
  REQUIRE(m.count == 2);
  CHECK(m.objects[0] + m.objects[1] == 11);
  for (int i = 0; i < 20; ++i) m.enter(i);
  CHECK(m.count == Media::kDeepest);
}
