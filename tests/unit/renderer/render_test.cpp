// SPDX-License-Identifier: Apache-2.0
#include "renderer/render.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/warp.h"
#include "renderer/layers.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

TEST_CASE(
    "the same seed gives the same picture bit for bit on 1, 2 and 3 threads; another does not") {
  double roughness = 0;
  bool filled = true;
  SUBCASE("rough glass, filled") { roughness = 0.2; }
  SUBCASE("polished glass, filled") {}
  SUBCASE("polished glass") { filled = false; }
  HandProgram h;
  h.surface("ball", HandProgram::lobe(Lobe::Dielectric, {h.spectrum(1.5), h.real(roughness),
                                                         h.spectrum(1), h.spectrum(1), h.real(0)}));
  if (filled) h.volume("ball", 2, 0.1);
  const Scene s = builtin(h.program, "sphere");
  const Film one = run(h.program, s, options(48, 20, 1)).film;
  const Film two = run(h.program, s, options(48, 20, 2)).film;
  const Film three = run(h.program, s, options(48, 20, 3)).film;
  CHECK(one.xyz == two.xyz);
  CHECK(one.xyz == three.xyz);
  CHECK(one.variance == two.variance);
  RenderOptions other = options(48, 20, 2);
  other.seed = 12;
  CHECK(run(h.program, s, other).film.xyz != one.xyz);
}

TEST_CASE(
    "furnace: white matte, thesis glossy, mirror and polished glass vanish in uniform light") {
  HandProgram h;
  SUBCASE("matte") { h.matte("x", 1); }
  SUBCASE("glossy 10") {
    h.surface("x", HandProgram::lobe(Lobe::Glossy, {h.spectrum(1), h.real(10)}));
  }
  SUBCASE("glossy 100") {
    h.surface("x", HandProgram::lobe(Lobe::Glossy, {h.spectrum(1), h.real(100)}));
  }
  SUBCASE("mirror") { h.surface("x", HandProgram::lobe(Lobe::Mirror, {h.spectrum(1)})); }
  SUBCASE("glass") {
    h.surface("x", HandProgram::lobe(Lobe::Dielectric, {h.spectrum(1.5), h.real(0), h.spectrum(1),
                                                        h.spectrum(1), h.real(0)}));
  }
  SUBCASE("thin veil: half scattered, half straight through") {
    vm::Descriptor& d = h.matte("x", 1);
    for (vm::Entry* e : HandProgram::entries(d)) e->scattering = h.spectrum(0.5);
  }
  const Rendered r = run(h.program, builtin(h.program, "furnace"), options(96, 48));
  check_mean(r.film, 1);
  // Nor may the ball be seen: its middle against the whole, each with its own error.
  Film middle{32, 32, {}, {}};
  for (int y = 32; y < 64; ++y)
    for (int x = 32; x < 64; ++x) {
      middle.xyz.push_back(r.film.xyz[y * 96 + x]);
      middle.variance.push_back(r.film.variance[y * 96 + x]);
    }
  check_mean(middle, 1);
}

TEST_CASE("furnace: a cloud that only scatters vanishes, homogeneous and by delta tracking") {
  HandProgram h;
  vm::Descriptor& d = h.volume("x", 1.5, 0);
  SUBCASE("closed form") {}
  SUBCASE("delta tracking") {
    d.outputs[int(vm::Output::Scattering)].variables = 1u << int(vm::Variable::Position);
    for (vm::Entry* e : HandProgram::entries(d)) e->bound = h.real(3);
  }
  const Rendered r = run(h.program, builtin(h.program, "furnace"), options(64, 48));
  check_mean(r.film, 1);
  CHECK(r.report.media_steps > 0);
}

TEST_CASE("direct light of a disc: E = pi L r^2 / (r^2 + h^2) above its axis") {
  HandProgram h;
  h.matte("ground", 0.6);
  // Light faces down: normal -y. Radius 1.5 at height 2; the camera looks from below it.
  const Scene s = scene_of(h.program, patch(R"(,{"disc": {"center": [0, 2, 0], "normal": [0, -1, 0],
      "radius": 1.5}, "surface": "lamp"})"));
  const Rendered r = run(h.program, s, options(16, 64));
  check_mean(r.film, 0.6 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 4));
}

TEST_CASE("direct light of a sphere: E = pi L (r / d)^2 for one wholly above the horizon") {
  HandProgram h;
  h.matte("ground", 0.6);
  const double x = 1.5, y = 2;
  const Scene s = scene_of(h.program, patch(R"(,{"sphere": {"center": [1.5, 2, 0], "radius": 0.5},
      "surface": "lamp"})"));
  const Rendered r = run(h.program, s, options(16, 64));
  const double d2 = x * x + y * y;
  check_mean(r.film, 0.6 * 2 * (0.25 / d2) * y / std::sqrt(d2));
}

TEST_CASE("a script's own emission lights like the scene's, and is asked for in batches") {
  HandProgram h;
  vm::Descriptor& d = h.matte("lamp2", 0);
  // Constant, so the machine never runs; 2 at every wavelength has luminance 2 / Y(D65).
  for (vm::Entry* e : HandProgram::entries(d)) e->emission = h.spectrum(2);
  h.matte("ground", 0.6);
  SceneSource source;
  source.surface = "ground";
  Result<SceneData> data = parse_scene(h.program, source, patch(R"(,{"disc": {"center": [0, 2, 0],
      "normal": [0, -1, 0], "radius": 1.5}, "surface": "lamp2"})"),
                                       "test", "");
  REQUIRE(bool(data));
  const Scene s(std::make_shared<const SceneData>(std::move(*data)));
  const Rendered r = run(h.program, s, options(16, 64));
  // CIE 15: Y of D65 scaled to 1 at 560 nm over Y of the equal-energy spectrum: 105.671 / 106.857
  // (1 nm rows, 360-830 nm).
  const double d65 = 105.671 / 106.857;
  const Mean m = mean_luminance(r.film);
  CHECK(std::abs(m.value - 0.6 * 2 / d65 * 2.25 / 6.25) < 4 * m.error + 0.002);
  CHECK(r.report.emission_runs == 0);
}

TEST_CASE("absorption along a known length: Beer-Lambert for the ball's diameter") {
  HandProgram h;
  h.volume("x", 0, 0.7);
  // A narrow view through the centre: 2 m of the medium, refraction none.
  const Scene s =
      scene_of(h.program, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
    "environment": {"constant": 1}, "objects": [{"sphere": {"radius": 1}, "test": true}]})");
  const Rendered r = run(h.program, s, options(8, 64));
  check_mean(r.film, std::exp(-1.4));
}

TEST_CASE("shadow rays are dimmed by veils and media alike") {
  HandProgram h;
  h.matte("ground", 0.6);
  vm::Descriptor& veil = h.matte("veil", 0);  // scatters nothing, absorbs 0.3 of what passes
  for (vm::Entry* e : HandProgram::entries(veil)) {
    e->scattering = h.spectrum(0);
    e->absorption = h.spectrum(0.3);
  }
  SceneSource source;
  source.surface = "ground";
  Result<SceneData> data = parse_scene(h.program, source, patch(R"(,{"disc": {"center": [0, 2, 0],
      "normal": [0, -1, 0], "radius": 1.5}, "surface": "lamp"}, {"quad": {"corner": [-3, 1.5, 3],
      "u": [6, 0, 0], "v": [0, 0, -6]}, "surface": "veil"})"),
                                       "test", "");
  REQUIRE(bool(data));
  const Rendered r =
      run(h.program, Scene(std::make_shared<const SceneData>(std::move(*data))), options(16, 64));
  check_mean(r.film, 0.7 * 0.6 * 2 * 2.25 / 6.25);
}

TEST_CASE("light that scattering finds through a veil is weighed by its chance to pass") {
  HandProgram h;
  h.matte("ground", 0.6);
  vm::Descriptor& veil = h.matte("veil", 0);  // half of what comes is scattered, and lost there
  for (vm::Entry* e : HandProgram::entries(veil)) e->scattering = h.spectrum(0.5);
  SceneSource source;
  source.surface = "ground";
  Result<SceneData> data = parse_scene(h.program, source, patch(R"(,{"disc": {"center": [0, 2, 0],
      "normal": [0, -1, 0], "radius": 1.5}, "surface": "lamp"}, {"quad": {"corner": [-3, 1.5, 3],
      "u": [6, 0, 0], "v": [0, 0, -6]}, "surface": "veil"})"),
                                       "test", "");
  REQUIRE(bool(data));
  const Rendered r =
      run(h.program, Scene(std::make_shared<const SceneData>(std::move(*data))), options(32, 256));
  check_mean(r.film, 0.5 * 0.6 * 2 * 2.25 / 6.25);
}

TEST_CASE(
    "a lamp through fog that only removes light: both ways of finding it, and the quadrature") {
  HandProgram h;
  h.matte("ground", 0.6);
  const double sigma = 0.5;
  vm::Descriptor& fog = h.volume("fog", sigma, 0);
  // A phase function of weight 0: what is scattered is lost.
  const vm::MaterialLayout none{
      {{int(Lobe::Isotropic), {}, {}}, {int(Lobe::Scale), {h.spectrum(0)}, {0}}}};
  for (vm::Entry* e : HandProgram::entries(fog)) e->material = none;
  SUBCASE("closed form") {}
  SUBCASE("by tentative collisions") {
    fog.outputs[int(vm::Output::Scattering)].variables = 1u << int(vm::Variable::Position);
    for (vm::Entry* e : HandProgram::entries(fog)) e->bound = h.real(1.2);
  }
  SceneSource source;
  source.surface = "ground";
  Result<SceneData> data = parse_scene(h.program, source, R"({
    "camera": {"position": [0, 1.2, 0], "target": [0, 0, 0], "up": [0, 0, -1], "fov": 0.01},
    "materials": {"lamp": {"matte": 0, "emission": 2}, "nothing": {"invisible": true}},
    "objects": [{"quad": {"corner": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2]}, "test": true},
      {"disc": {"center": [0, 2, 0], "normal": [0, -1, 0], "radius": 1.5}, "surface": "lamp"},
      {"sphere": {"radius": 50}, "surface": "nothing", "volume": "fog"}]})",
                                       "test", "");
  REQUIRE_MESSAGE(bool(data), (data ? "" : data.error().what));
  const Rendered r =
      run(h.program, Scene(std::make_shared<const SceneData>(std::move(*data))), options(32, 256));
  // E = 2 pi L times the integral of mu exp(-sigma h / mu) over the cosines of the disc.
  const int steps = 100000;
  const double low = 2 / 2.5;
  double integral = 0;
  for (int i = 0; i < steps; ++i) {
    const double mu = low + (1 - low) * (i + 0.5) / steps;
    integral += mu * std::exp(-sigma * 2 / mu) * (1 - low) / steps;
  }
  check_mean(r.film, std::exp(-sigma * 1.2) * 0.6 * 2 * 2 * integral);
}

TEST_CASE("an emitting medium: L = e (1 - exp(-a d)) / a along the diameter") {
  HandProgram h;
  vm::Descriptor& d = h.volume("x", 0, 0.8);
  for (vm::Entry* e : HandProgram::entries(d)) e->emission = h.spectrum(0.5);
  SUBCASE("closed form") {}
  SUBCASE("by tentative collisions") {
    d.outputs[int(vm::Output::Absorption)].variables = 1u << int(vm::Variable::Position);
    for (vm::Entry* e : HandProgram::entries(d)) e->bound = h.real(2);
  }
  const Scene s =
      scene_of(h.program, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
    "objects": [{"sphere": {"radius": 1}, "test": true}]})");
  const Rendered r = run(h.program, s, options(16, 64));
  const double expected = 0.5 * (1 - std::exp(-1.6)) / 0.8 * 106.857 / 105.671;
  const Mean m = mean_luminance(r.film);
  CHECK(std::abs(m.value - expected) < 4 * m.error + 0.001 * expected);
}

TEST_CASE(
    "a closed white box with a dim wall is as bright as the series says: rho 0.5, emission 0.5 is "
    "1") {
  HandProgram h;
  vm::Descriptor& d = h.matte("x", 0.5);
  // Seen from inside: the emission of a matte shape is on the side of the normal, so the ball
  // wears it outwards and a box of six quads would be needed; quads face inwards here.
  for (vm::Entry* e : HandProgram::entries(d)) e->emission = h.spectrum(0.5);
  const Scene s = scene_of(
      h.program, R"({"camera": {"position": [0.3, 0.1, 0.2], "target": [0, 0, -1], "fov": 90},
    "objects": [
    {"quad": {"corner": [-1, -1, 1], "u": [2, 0, 0], "v": [0, 0, -2]}, "test": true},
    {"quad": {"corner": [-1, 1, -1], "u": [2, 0, 0], "v": [0, 0, 2]}, "test": true},
    {"quad": {"corner": [-1, -1, -1], "u": [2, 0, 0], "v": [0, 2, 0]}, "test": true},
    {"quad": {"corner": [1, -1, 1], "u": [-2, 0, 0], "v": [0, 2, 0]}, "test": true},
    {"quad": {"corner": [-1, -1, 1], "u": [0, 0, -2], "v": [0, 2, 0]}, "test": true},
    {"quad": {"corner": [1, -1, -1], "u": [0, 0, 2], "v": [0, 2, 0]}, "test": true}]})");
  const Rendered r = run(h.program, s, options(32, 64));
  const Mean m = mean_luminance(r.film);
  const double expected = 106.857 / 105.671;
  CHECK(std::abs(m.value - expected) < 4 * m.error + 0.001);
}

TEST_CASE("a render models only what the scene needs: the counters say so") {
  HandProgram h;
  h.matte("x", 0.5);
  const Rendered r = run(h.program, builtin(h.program, "sphere"), options(16, 4));
  CHECK(r.report.script_runs == 0);
  CHECK(r.report.media_steps == 0);
  CHECK(r.report.medium_runs == 0);
  CHECK(r.report.emission_runs == 0);
  CHECK(r.report.paths == 16 * 16 * 4);
  CHECK(r.report.rays >= r.report.paths);
  CHECK(r.report.shadow_rays > 0);
  CHECK(r.report.samples == 4);
  CHECK(r.report.rmse > 0);
  CHECK_FALSE(r.report.stopped);
}

TEST_CASE("stop ends a render with what is there, and progress is reported") {
  HandProgram h;
  h.matte("x", 0.5);
  std::atomic<bool> stop{false};
  RenderOptions o = options(64, 1 << 20, 2);
  o.stop = &stop;
  int calls = 0;
  o.progress = [&](const Progress& p) {
    CHECK(p.fraction >= 0);
    CHECK(p.fraction <= 1);
    CHECK(p.seconds >= 0);
    if (++calls == 3) stop = true;
  };
  const Rendered r = run(h.program, builtin(h.program, "sphere"), o);
  CHECK(r.report.stopped);
  CHECK(r.report.samples < (1 << 20));
  CHECK(r.report.paths > 0);
  CHECK(calls >= 3);
}

TEST_CASE("options out of range are errors that say what is allowed") {
  HandProgram h;
  h.matte("x", 0.5);
  const Scene s = builtin(h.program, "sphere");
  RenderOptions o = options(16, 0);
  CHECK(render(h.program, s, o).error().what == "0 samples a pixel");
  o = options(0, 1);
  CHECK(render(h.program, s, o).error().where == "size");
  o = options(16, 1);
  o.max_depth = 0;
  CHECK(render(h.program, s, o).error().where == "depth");
}

TEST_CASE("a volume without a finite bound is an error, and the message says so") {
  HandProgram h;
  vm::Descriptor& d = h.volume("cloud", std::numeric_limits<double>::infinity(), 0);
  d.outputs[int(vm::Output::Scattering)].variables = 1u << int(vm::Variable::Position);
  const Result<Rendered> r = render(h.program, builtin(h.program, "furnace"), options(8, 1));
  REQUIRE_FALSE(bool(r));
  CHECK(r.error().what.find("`cloud`") != std::string::npos);
  CHECK(r.error().hint.find("bound") != std::string::npos);
}

TEST_CASE("a bump never shows black: white matte under a steep gradient still gives light back") {
  HandProgram h;
  vm::Descriptor& d = h.matte("x", 1);
  for (vm::Entry* e : HandProgram::entries(d)) {
    e->gradient[0] = h.real(3);
    e->gradient[1] = h.real(-2);
  }
  const Rendered r = run(h.program, builtin(h.program, "furnace"), options(64, 64));
  for (const auto& p : r.film.xyz) {
    // The tilted hemisphere keeps at least the part above the surface: with the view held above the
    // horizon by the frame, over a quarter of it is left.
    CHECK(p[1] > 0.2);
    CHECK(p[1] < 1.5);
  }
}

TEST_CASE("bumps of all of a material are those of its surface") {
  for (const std::string of : {"gold(0.2)", "coat(mirror(), matte(0.5), 0.0)", "dielectric(1.5)",
                               "mix(matte(0.4), dielectric(1.5, 0.4), 0.6)"}) {
    INFO(of);
    const std::string bumps = "0.01 * perlin(20 * $object_position)";
    RenderOptions o = options(24, kSanitized ? 2 : 16);
    o.layers = true;
    const auto see = [&](const std::string& outputs) {
      const vm::Program p = compile("surface s " + outputs + " end");
      return run(p, builtin(p, "sphere"), o);
    };
    const Rendered part = see("bsdf = bumped(" + of + ", " + bumps + ");"),
                   all = see("bsdf = " + of + "; height = " + bumps + ";"),
                   flat = see("bsdf = " + of + ";");
    const auto differ = [&](const Rendered& r, double bound) {
      int count = 0;
      for (std::size_t i = 0; i < r.film.xyz.size(); ++i)
        count += std::abs(r.film.xyz[i][1] - all.film.xyz[i][1]) > bound * all.film.xyz[i][1];
      return count;
    };
    CHECK(differ(flat, 0.01) > 40);
    // Where glass is all there is, paths go both ways at once (Scatterer::divides); and in rough
    // glass they part by roundings.
    if (of.find("dielectric") != std::string::npos) {
      const Mean a = mean_luminance(part.film), b = mean_luminance(all.film);
      CHECK(std::abs(a.value - b.value) < 4 * std::hypot(a.error, b.error));
      continue;
    }
    CHECK(differ(part, 1e-4) <= 3);  // so may a path here
    // The albedo of a surface has what leaves to its back too.
    for (std::size_t i = 0; i < part.film.xyz.size(); ++i)
      CHECK(part.layers->albedo[i][0] <= all.layers->albedo[i][0] * (1 + 1e-4f));
  }
}
