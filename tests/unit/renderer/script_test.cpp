// SPDX-License-Identifier: Apache-2.0
// The renderer with compiled scripts: what runs, how often, and what a budget fault does.
#include <doctest/doctest.h>

#include <cmath>

#include <fmt/format.h>

#include "base/warp.h"
#include "renderer/enclosure.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// A wall that fills the view, in even light.
const std::string kWall = R"({"camera": {"position": [0, 0, 3], "target": [0, 0, 0], "fov": 30},
  "environment": {"constant": 1},
  "objects": [{"quad": {"corner": [-1, -1, 0], "u": [2, 0, 0], "v": [0, 2, 0]}, "test": true}]})";
const std::string kBall = R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 10},
  "environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})";

}  // namespace

TEST_CASE("a pattern is seen where it is written: half white, half grey over uv") {
  const vm::Program p =
      compile("surface a\n bsdf = matte(select 1.0, if $uv.x < 0.5; 0.25 otherwise; end);\nend\n");
  Result<Rendered> r = render(p, scene_of(p, kWall), options(32, 16));
  REQUIRE(bool(r));
  // Even light on a flat wall, seen from before it: each pixel is its albedo, but for the noise of
  // eight wavelengths, which the mean of 10 rows of 16 samples leaves below 0.5 %.
  double left = 0, right = 0;
  for (int y = 10; y < 20; ++y) {
    left += r->film.xyz[std::size_t(y) * 32 + 8][1] / 10;
    right += r->film.xyz[std::size_t(y) * 32 + 24][1] / 10;
  }
  CHECK(left == doctest::Approx(1).epsilon(0.02));
  CHECK(right == doctest::Approx(0.25).epsilon(0.02));
  CHECK(r->report.script_runs > 0);
  CHECK(r->report.script_points == 32 * 32 * 16);
  CHECK(r->report.batch_fill > 0.5);
  CHECK(r->report.pass_runs == 0);
  CHECK(r->report.emission_runs == 0);
}

TEST_CASE("scripts are run on full batches, of surfaces and along volumes") {
  const vm::Program p = compile(
      "surface a\n bsdf = mix(matte($uv.x), matte($uv.y), 0.5);\nend\n"
      "surface thin\n scattering = $uv.x;\nend\n"
      "volume fog\n scattering = 1 + $object_position.z; bound = 2;\nend\n");
  for (const char* wears :
       {R"("surface": "a")", R"("surface": "thin")", R"("surface": "none", "volume": "fog")"}) {
    CAPTURE(wears);
    const std::string scene =
        std::string(R"({"environment": {"constant": 1}, "objects": [
      {"sphere": {}, )") +
        wears + R"(}, {"quad": {"corner": [-9, -1, 9], "u": [18, 0, 0], "v": [0, 0, -18]},
       "surface": "floor"}], "materials": {"floor": {"matte": 0.5}, "none": {"invisible": true}},
       "camera": {"position": [0, 1, 3], "target": [0, 0, 0]}})";
    RenderOptions o = options(256, 2);
    o.threads = 1;
    Result<Rendered> r = render(p, scene_of(p, scene), o);
    REQUIRE(bool(r));
    CHECK(r->report.batch_fill > 0.75);
  }
}

TEST_CASE(
    "a constant material runs nothing; a hole runs `pass`; a glow runs `emit` for its own light") {
  const vm::Program constant = compile("surface a\n bsdf = matte(0.5);\nend\n");
  CHECK(render(constant, scene_of(constant, kBall), options(16, 4))->report.script_runs == 0);

  const vm::Program hole =
      compile("surface a\n scattering = select 1.0, if $uv.x < 0.5; 0.0 otherwise; end;\nend\n");
  Result<Rendered> r = render(hole, scene_of(hole, kBall), options(16, 4));
  REQUIRE(bool(r));
  CHECK(r->report.pass_runs > 0);
  CHECK(r->report.emission_runs == 0);
  const Mean seen = mean_luminance(r->film);
  // White, inside and out, in even light: what is left of chance is less than what float keeps.
  CHECK(std::abs(seen.value - 1) < 4 * seen.error + 1e-6);

  const vm::Program glow = compile("surface a\n bsdf = matte(0.5); emission = $uv.x;\nend\n");
  r = render(glow, scene_of(glow, R"({"environment": {"constant": 1}, "objects": [
    {"sphere": {}, "test": true}, {"quad": {"corner": [-9, -1, 9], "u": [18, 0, 0], "v": [0, 0, -18]},
     "surface": "floor"}], "materials": {"floor": {"matte": 0.5}},
     "camera": {"position": [0, 3, 6], "target": [0, 0, 0]}})"),
             options(16, 4));
  REQUIRE(bool(r));
  CHECK(r->report.emission_runs > 0);
  CHECK(r->report.media_steps == 0);
}

TEST_CASE("a volume that varies is tracked: optical depth along the diameter of a linear density") {
  // absorption 0.4 (1 + z) integrates to 0.8 over z in [-1, 1].
  const vm::Program p =
      compile("volume a\n absorption = 0.4 * (1 + $object_position.z); bound = 0.8;\nend\n");
  const std::string narrow =
      R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
    "environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})";
  Result<Rendered> r = render(p, scene_of(p, narrow), options(16, 64));
  REQUIRE(bool(r));
  const Mean m = mean_luminance(r->film);
  CHECK(std::abs(m.value - std::exp(-0.8)) < 4 * m.error);
  CHECK(r->report.medium_runs > 0);
}

TEST_CASE(
    "a volume that states no bound takes it from its enclosure; one that is too small is told") {
  const std::string narrow =
      R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
    "environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})";
  const auto rendered = [&](const char* absorption, const char* bound) {
    const vm::Program p =
        compile(std::string("volume a\n absorption = ") + absorption + ";" + bound + "\nend\n");
    return render(p, scene_of(p, narrow), options(16, 64));
  };
  Result<Rendered> r = rendered("0.4 * (1 + $object_position.z)", "");
  REQUIRE(bool(r));
  const Mean m = mean_luminance(r->film);
  CHECK(std::abs(m.value - std::exp(-0.8)) < 4 * m.error);
  CHECK(r->report.medium_samples > 0);
  CHECK(r->report.denser_samples == 0);

  // The bound 0.4 holds in one half; in the other the volume is held at it: 0.4 (1/2 + 1).
  r = rendered("0.4 * (1 + $object_position.z)", "bound = 0.4;");
  REQUIRE(bool(r));
  const Mean held = mean_luminance(r->film);
  CHECK(std::abs(held.value - std::exp(-0.6)) < 4 * held.error);
  CHECK(r->report.denser_samples > r->report.medium_samples / 4);
  CHECK(r->report.denser_samples < r->report.medium_samples * 3 / 4);

  // Where no enclosure is finite, the author must say.
  r = rendered("1 / abs($object_position.z)", "");
  REQUIRE_FALSE(bool(r));
  CHECK(r.error().what.find("states no `bound`, and none is found") != std::string::npos);
}

TEST_CASE("enclosures of an object's script hold over its own box") {
  const vm::Program p = compile(
      "surface a\n height = 0.1 * $object_position.x + 0.5;\nend\n"
      "volume a\n scattering = 2 + sin(3 * $position.x); absorption = rgb(1, 0, 0);\nend\n");
  Object o;
  o.shape = Sphere{{4, 0, 0}, 2};
  o.transform.scale = 2;
  o.transform.move = {4, 0, 0};
  const double height = largest_height(p, *p.find(vm::DescriptorForm::Surface, "a"), o);
  CHECK(height >= 0.6);
  CHECK(height < 0.601);
  const double extinction =
      majorants_of(p, *p.find(vm::DescriptorForm::Volume, "a"), o, 1e30).largest();
  CHECK(extinction >= 4);
  CHECK(extinction < 4.01);
}

TEST_CASE("endless recursion is an error that names the line, before anything is rendered") {
  const vm::Program p = compile(
      "real spin(integer n)\n"
      "  return select 0.0, if n == -1; spin(n + 1) otherwise; end;\n"
      "surface a\n  bsdf = matte(spin(integer(1000 * $uv.x)));\nend\n");
  const Result<Rendered> r = render(p, scene_of(p, kWall), options(8, 1));
  REQUIRE_FALSE(bool(r));
  CHECK(r.error().where.starts_with("t.mms:"));
  CHECK(r.error().what.find("1048576") != std::string::npos);
}

TEST_CASE(
    "what the probe missed is counted with its line, takes the default, and ends the render") {
  // One thousandth of the wall recurses too deep; 256 points of the probe miss it (the seed is
  // fixed).
  const vm::Program p = compile(
      "real spin(integer n)\n"
      "  return select 0.0, if n == -1; 1 + spin(n + 1) otherwise; end;\n"
      "surface a\n"
      "  bsdf = matte(select spin(integer(10 * $uv.x)), if 0.5 < $uv.x and $uv.x < 0.501; 0.5 "
      "otherwise; end);\n"
      "end\n");
  Result<Rendered> r = render(p, scene_of(p, kWall), options(32, 8));
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().what));
  CHECK(r->report.fault_lanes > 0);
  REQUIRE(r->report.faults.size() == 1);
  CHECK(r->report.faults[0].where.starts_with("t.mms:"));
  CHECK(r->report.faults[0].lanes == r->report.fault_lanes);
  CHECK(r->report.dropped.count() == 0);
  CHECK_FALSE(r->report.too_many_faults);

  r = render(p, scene_of(p, kWall), options(128, 256));
  REQUIRE(bool(r));
  CHECK(r->report.too_many_faults);
  CHECK(r->report.samples < 256);
}

/// What a render of a wall tells that wears `a` in its upper half and `b` in its lower one; samples
/// were dropped.
static std::vector<NotFinite> told_of_halves(const vm::Program& p) {
  const Result<Rendered> r = render(p, scene_of(p, R"({
    "camera": {"position": [0, 0, 3], "target": [0, 0, 0], "fov": 40}, "environment": {"constant": 1},
    "objects": [{"quad": {"corner": [-1, 0, 0], "u": [2, 0, 0], "v": [0, 1, 0]}, "surface": "a"},
      {"quad": {"corner": [-1, -1, 0], "u": [2, 0, 0], "v": [0, 1, 0]}, "surface": "b"}]})"),
                                    options(8, 2));
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().what));
  CHECK(r->report.dropped.count() > 0);
  return r->report.not_finite;
}

TEST_CASE("what is not finite is told: descriptor, output and place, once for each descriptor") {
  const vm::Program p = compile(
      "surface a\n"
      "  bsdf = matte(sqrt($uv.x - 0.5));\n"
      "  emission = 1e-3 * $wavelength;\n"
      "end\n"
      "surface b\n  bsdf = matte(0.5); emission = 1 / ($uv.y - $uv.y);\nend\n");
  const std::vector<NotFinite> told = told_of_halves(p);
  REQUIRE(told.size() == 2);
  const NotFinite &a = told[0], &b = told[1];
  CHECK(a.descriptor == "a");
  CHECK(a.output == "bsdf");
  CHECK(b.descriptor == "b");
  CHECK(b.output == "emission");
  // The place is one where it happens: the root of what is below 0.
  const std::size_t uv = a.settings.find("--set uv=[");
  REQUIRE(uv != std::string::npos);
  const double x = std::stod(a.settings.substr(uv + 10));
  CHECK(x < 0.5);
  CHECK(x >= 0);
}

TEST_CASE("a constant that is not a number and a gradient that is none are named too") {
  const vm::Program p = compile(
      "surface a\n  bsdf = matte(sqrt(-1));\nend\n"
      "surface b\n  bsdf = matte(0.5); gradient = [sqrt($uv.x - 2), 0];\nend\n");
  const std::vector<NotFinite> told = told_of_halves(p);
  REQUIRE(told.size() == 2);
  const NotFinite &a = told[0], &b = told[1];
  CHECK(a.descriptor == "a");
  CHECK(a.output == "bsdf");
  CHECK(a.settings == "");  // it is so everywhere
  CHECK(b.descriptor == "b");
  CHECK(b.output == "gradient");
  CHECK(b.settings.find("--set uv=[") != std::string::npos);
}

TEST_CASE("what is not finite of a volume, and of what a surface lets through, is told") {
  const auto check_told = [](const std::string& script, const std::string& scene,
                             const std::string& output) {
    const vm::Program p = compile(script);
    const Result<Rendered> r = render(p, scene_of(p, scene), options(8, 16));
    REQUIRE(bool(r));
    CHECK(r->report.dropped.nan > 0);
    REQUIRE_MESSAGE(r->report.not_finite.size() == 1, output);
    CHECK(r->report.not_finite[0].descriptor == "a");
    CHECK(r->report.not_finite[0].output == output);
  };
  for (const char* output : {"scattering", "absorption", "emission"})
    check_told(fmt::format("volume a\n {} = sqrt($position.x); bound = 2;\nend\n", output), kBall,
               output);
  check_told("surface a\n scattering = sqrt($uv.x - 0.5);\nend\n", kWall, "scattering");
  check_told("surface a\n scattering = 0.5; absorption = sqrt($uv.x - 0.5);\nend\n", kWall,
             "absorption");
}

TEST_CASE("negative emission counts as none, of surfaces and of volumes") {
  for (const char* form :
       {"surface a\n emission = {};\nend\n", "surface a\n scattering = 0.5; emission = {};\nend\n",
        "volume a\n absorption = 0.1; bound = 0.1; emission = {};\nend\n"}) {
    const auto picture = [&](const char* emission) {
      const vm::Program p = compile(fmt::format(fmt::runtime(form), emission));
      return run(p, scene_of(p, kBall), options(16, 4)).film.xyz;
    };
    CHECK(picture("$position.x") == picture("max($position.x, 0.0)"));
    CHECK_FALSE(picture("$position.x") == picture("0.0"));
  }
}

TEST_CASE("negative emission counts as none, of surfaces and of volumes") {
  const auto picture = [](const std::string& script, const std::string& scene) {
    const vm::Program p = compile(script);
    return run(p, scene_of(p, scene), options(16, 4)).film.xyz;
  };
  for (const char* form :
       {"surface a\n emission = {};\nend\n", "surface a\n scattering = 0.5; emission = {};\nend\n",
        "volume a\n absorption = 0.1; bound = 0.1; emission = {};\nend\n"}) {
    const auto of = [&](const char* emission) {
      return picture(fmt::format(fmt::runtime(form), emission), kBall);
    };
    CHECK(of("$position.x") == of("max($position.x, 0.0)"));
    CHECK_FALSE(of("$position.x") == of("0.0"));
  }
}

TEST_CASE("a lossless material is as bright as its light, in a render") {
  // To what each keeps by quadrature (tests/accuracy): 1e-3, and the least of either.
  for (const char* bsdf : {"matte(1)",
                           "translucent(1)",
                           "rough_matte(1, 0.5)",
                           "glossy(1, 3)",
                           "glossy(1, 1000)",
                           "glossy_back(1)",
                           "glossy_through(1)",
                           "glossy_refraction(1.5)",
                           "mirror(1)",
                           "microfacet(1, 0.5)",
                           "microfacet(1, 0.5, 0.7)",
                           "beckmann(1, 0.7)",
                           "conductor(1, 1e25, 0.4)",
                           "dielectric(1.5)",
                           "dielectric(1.5, 0.4)",
                           "dielectric(1.1, 0.8)",
                           "beckmann_dielectric(1.5, 0.4)",
                           "slab(1.5)",
                           "film_dielectric(1.5, 1.38, 300nm, $wavelength)",
                           "fresnel_mix(matte(1), glossy(1, 30))",
                           "coat(mirror(1), matte(1))",
                           "coat(mirror(1), microfacet(1, 0.5))",
                           "layer(sheen(1, 0.5), matte(1))",
                           "mix(matte(1), mix(mirror(1), dielectric(1.3), 0.5), 0.7)"}) {
    const vm::Program p = compile(fmt::format("surface s\n bsdf = {};\nend\n", bsdf));
    RenderOptions o = options(kSanitized ? 8 : 24, kSanitized ? 16 : 64);
    o.max_depth = 1000;  // of paths that go to and fro inside
    const Mean seen = mean_luminance(run(p, builtin(p, "furnace"), o).film);
    CHECK_MESSAGE(std::abs(seen.value - 1) < 4 * seen.error + 1e-3, bsdf, ": ", seen.value);
  }
}

TEST_CASE("a bump loses what the tilted hemisphere has below the surface") {
  // Of Lambert's lobe about a normal that is tilted by t, a share (1 - cos t) / 2 is below the
  // plane: what leaves to there or comes from there is dropped, as nothing passes the surface. At
  // slope 1 the view would be mirrored into the surface: the normal is held back to where it is
  // mirrored 0.01 above.
  const std::string open = R"({"camera": {"position": [0, 0, 3], "target": [0, 0, 0], "fov": 1},
    "environment": {"constant": 1}, "objects": [
    {"quad": {"corner": [-1, -1, 0], "u": [2, 0, 0], "v": [0, 2, 0]}, "test": true}]})";
  for (const double slope : {0.0, 0.3, 0.9, 1.0}) {
    const vm::Program p =
        compile(fmt::format("surface s\n bsdf = matte(1); gradient = [{:.1f}, 0];\nend\n", slope));
    const Result<Rendered> r = render(p, scene_of(p, open), options(16, 256));
    REQUIRE(bool(r));
    const Mean seen = mean_luminance(r->film);
    const double tilt = std::min(std::atan(slope), std::acos(0.01) / 2);
    const double kept = (1 + std::cos(tilt)) / 2;
    CHECK_MESSAGE(std::abs(seen.value - kept) < 4 * seen.error + 1e-3, slope, ": ", seen.value);
  }
}

TEST_CASE("bump tilts the light: a wall with height a x, lit from one side by a far small disc") {
  // Lambert under a light along l: n . l with n = (-a, 0, 1) / sqrt(1 + a^2).
  const double a = 0.5;
  const vm::Program bumped =
      compile("surface s\n bsdf = matte(0.5); height = 0.5 * $object_position.x;\nend\n");
  const vm::Program flat = compile("surface s\n bsdf = matte(0.5);\nend\n");
  const std::string lit = R"({"camera": {"position": [0, 0, 3], "target": [0, 0, 0], "fov": 1},
    "materials": {"lamp": {"matte": 0, "emission": 1000}}, "objects": [
    {"quad": {"corner": [-1, -1, 0], "u": [2, 0, 0], "v": [0, 2, 0]}, "test": true},
    {"disc": {"center": [-60, 0, 80], "normal": [6, 0, -8], "radius": 2}, "surface": "lamp"}]})";
  const Result<Rendered> b = render(bumped, scene_of(bumped, lit), options(16, 64));
  const Result<Rendered> f = render(flat, scene_of(flat, lit), options(16, 64));
  REQUIRE(bool(b));
  REQUIRE(bool(f));
  const double tilted = (0.6 * a + 0.8) / std::sqrt(1 + a * a);
  // The same seed draws the same light points, so the ratio is free of their noise; the disc
  // spans 2 degrees, and the patch 0.03 m: relative 1e-3.
  CHECK(mean_luminance(b->film).value / mean_luminance(f->film).value ==
        doctest::Approx(tilted / 0.8).epsilon(2e-3));
}

TEST_CASE("where the weights of a material that varies add up to more than 1 is counted") {
  const auto gains = [](const std::string& bsdf) {
    const vm::Program p = compile("surface a\n bsdf = " + bsdf + ";\nend\n");
    Result<Rendered> r = render(p, scene_of(p, kWall), options(32, 16));
    REQUIRE(bool(r));
    return r->report.gains;
  };
  CHECK(gains("mix(matte(0.9), mirror(0.9), $uv.x)").empty());
  // 0.8 + u: of the wall this much lies to both sides of its middle, u = 0.5, in view.
  const double half = 1.5 * std::tan(kPi<double> / 12), share = (0.3 + half) / (2 * half);
  const auto found = gains("matte(0.8) + mirror($uv.x)");
  REQUIRE(found.size() == 1);
  CHECK(found[0].descriptor == "a");
  CHECK(found[0].where.ends_with(":1"));
  const auto of = double(found[0].of);
  CHECK(std::abs(double(found[0].points) / of - share) < 4 * std::sqrt(share * (1 - share) / of));
  CHECK(found[0].most == doctest::Approx(1.3 + half).epsilon(0.01));
}
