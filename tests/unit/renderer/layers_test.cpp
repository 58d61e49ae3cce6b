// SPDX-License-Identifier: Apache-2.0
#include "renderer/layers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "hand_program.h"
#include "renderer/picture.h"
#include "renderer/scene.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr int kSide = 65;

/// A ball of radius 1 before a lamp that fills a corner, seen along -z from 5 m; half of the
/// picture sees nothing.
constexpr std::string_view kScene = R"({
  "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 30},
  "materials": {"lamp": {"matte": 0.25, "emission": 2}},
  "objects": [{"sphere": {"radius": 1}, "test": true},
    {"quad": {"corner": [1, 1, 0], "u": [1, 0, 0], "v": [0, 1, 0]}, "surface": "lamp"}]})";

Rendered render_layers(const HandProgram& h, int threads) {
  Result<SceneData> data = parse_scene(h.program, {}, kScene, "test", "");
  REQUIRE(bool(data));
  RenderOptions o;
  o.width = o.height = kSide;
  o.samples = 16;
  o.threads = threads;
  o.layers = true;
  Result<Rendered> r =
      render(h.program, Scene(std::make_shared<const SceneData>(std::move(*data))), o);
  REQUIRE(bool(r));
  REQUIRE(r->layers);
  return std::move(*r);
}

std::size_t at(int x, int y) { return std::size_t(y) * kSide + std::size_t(x); }
constexpr int kMiddle = kSide / 2;

}  // namespace

TEST_CASE("layers hold what the camera sees first: a ball, a lamp, nothing") {
  HandProgram h;
  h.matte("ball", 0.3);
  const Rendered r = render_layers(h, 2);
  const Layers& l = *r.layers;
  // The middle pixel is 2 * 5 * tan(15 deg) / 65 = 0.041 m wide at the ball's centre, 0.033 m where
  // it is hit: 0.017 m from the middle at most, sunk by less than 0.017^2 there.
  const std::size_t middle = at(kMiddle, kMiddle);
  CHECK(l.depth[middle] == doctest::Approx(4).epsilon(0.0003));
  CHECK(std::abs(l.position[middle][0]) < 0.017);
  CHECK(std::abs(l.position[middle][1]) < 0.017);
  CHECK(l.position[middle][2] == doctest::Approx(1).epsilon(0.0006));
  CHECK(l.normal[middle][2] == doctest::Approx(1).epsilon(0.0006));
  REQUIRE(l.descriptor[middle] > 0);
  CHECK(l.names[l.descriptor[middle] - 1] == "ball");
  CHECK(l.emission[middle] == Layers::Triple{0, 0, 0});
  // (1.15, 1.15) of the picture plane through the origin is on the lamp; the other corner is empty.
  const int aside = int(1.15 / (5 * std::tan(15 * 3.14159265 / 180)) * (kSide / 2.0));
  const std::size_t lamp = at(kMiddle + aside, kMiddle - aside), none = at(2, kSide - 3);
  CHECK(l.names[l.descriptor[lamp] - 1] == "lamp");
  CHECK(l.normal[lamp] == Layers::Triple{0, 0, 1});
  CHECK(l.descriptor[none] == 0);
  CHECK(std::isinf(l.depth[none]));
  CHECK(l.albedo[none] == Layers::Triple{0, 0, 0});
  // Wavelengths are chance, sixteen stratified clusters of eight a pixel: means over a patch.
  const auto mean = [&](const std::vector<Layers::Triple>& layer, std::size_t around) {
    double sum[3] = {0, 0, 0};
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x)
        for (int k = 0; k < 3; ++k)
          sum[k] += double(layer[around + std::size_t(y * kSide + x)][std::size_t(k)]) / 25;
    return std::array{sum[0], sum[1], sum[2]};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(mean(l.albedo, middle)[k] == doctest::Approx(0.3).epsilon(0.01));
    CHECK(mean(l.albedo, lamp)[k] == doctest::Approx(0.25).epsilon(0.01));
    CHECK(mean(l.emission, lamp)[k] == doctest::Approx(2).epsilon(0.01));
  }
}

TEST_CASE("layers are the same on any number of threads") {
  HandProgram h;
  h.surface("ball", HandProgram::lobe(Lobe::Dielectric, {h.spectrum(1.5), h.real(0.2),
                                                         h.spectrum(1), h.spectrum(1), h.real(0)}));
  h.volume("ball", 2, 0.1);
  const auto one = render_layers(h, 1).layers, three = render_layers(h, 3).layers;
  CHECK(one->albedo == three->albedo);
  CHECK(one->normal == three->normal);
  CHECK(one->emission == three->emission);
  CHECK(one->descriptor == three->descriptor);
  // A clean dielectric without absorption scatters all: 1, but for the wavelengths of one pixel.
  double sum = 0;
  int count = 0;
  for (int y = -3; y <= 3; ++y)
    for (int x = -3; x <= 3; ++x, ++count) sum += one->albedo[at(kMiddle + x, kMiddle + y)][1];
  CHECK(sum / count == doctest::Approx(1).epsilon(0.06));  // facets of roughness 0.2 lose some
}

TEST_CASE("an EXR file holds every layer by name, and what is known of the picture") {
  HandProgram h;
  h.matte("ball", 0.3);
  const Rendered r = render_layers(h, 2);
  const std::string path =
      (std::filesystem::temp_directory_path() / "mms_layers_test.exr").string();
  REQUIRE(bool(write_picture(path, {r.film, r.layers.get(), {{"mms:seed", "7"}}})));
  const std::size_t middle = at(kMiddle, kMiddle);
  const auto check = [&](const char* name, std::array<float, 3> expected) {
    CAPTURE(name);
    const auto back = read_picture(path, name);
    REQUIRE(bool(back));
    CHECK(back->rgb[middle] == expected);
  };
  const Layers& l = *r.layers;
  check("albedo", l.albedo[middle]);
  check("normal", l.normal[middle]);
  check("position", l.position[middle]);
  check("emission", l.emission[middle]);
  const auto thrice = [](double v) { return std::array{float(v), float(v), float(v)}; };
  check("depth", thrice(l.depth[middle]));
  check("descriptor", thrice(l.descriptor[middle]));
  check("variance", thrice(r.film.variance[middle]));
  check("samples", thrice(16));
  check("dropped", thrice(0));
  const auto picture = read_picture(path);
  REQUIRE(bool(picture));
  CHECK(picture->variance[middle] == float(r.film.variance[middle]));
  const auto value = [&](const std::string& name) {
    for (const auto& [n, v] : picture->metadata)
      if (n == name) return v;
    return std::string("none");
  };
  CHECK(value("mms:seed") == "7");
  CHECK(value("mms:descriptors").find(std::to_string(l.descriptor[middle]) + " ball") !=
        std::string::npos);
  const auto wrong = read_picture(path, "albdo");
  REQUIRE_FALSE(bool(wrong));
  CHECK(wrong.error().hint.find("albedo") != std::string::npos);
  std::filesystem::remove(path);
}

TEST_CASE("the albedo of a surface that lies in something is of its index over that") {
  // Glass of water's index in water, whose reflection is black: it lets all light through. Over
  // vacuum it would lose what water reflects, 4 % over this picture.
  HandProgram h;
  const auto glass = [&](double reflected) {
    return HandProgram::lobe(Lobe::Dielectric, {h.spectrum(1.33), h.real(0), h.spectrum(reflected),
                                                h.spectrum(1), h.real(0)});
  };
  h.surface("water", glass(1));
  h.surface("glass", glass(0));
  Result<SceneData> data = parse_scene(h.program, {}, R"({
    "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 20},
    "objects": [{"sphere": {"radius": 20}, "surface": "water", "priority": 1},
      {"sphere": {"radius": 1}, "surface": "glass", "priority": 2}]})",
                                       "test", "");
  REQUIRE_MESSAGE(bool(data), (data ? "" : data.error().what));
  RenderOptions o;
  o.width = o.height = 16;
  o.samples = 16;
  o.layers = true;
  const Result<Rendered> r =
      render(h.program, Scene(std::make_shared<const SceneData>(std::move(*data))), o);
  REQUIRE(bool(r));
  const Layers& l = *r->layers;
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < l.albedo.size(); ++i) {
    if (l.descriptor[i] == 0 || l.names[l.descriptor[i] - 1] != "glass") continue;
    const Layers::Triple& a = l.albedo[i];
    sum += 0.2126 * a[0] + 0.7152 * a[1] + 0.0722 * a[2];
    ++n;
  }
  REQUIRE(n > 50);
  // Edges of the disc share pixels with the water behind, whose albedo is 1 too. One cluster sees
  // the luminance of white to 0.6 % (tests of clusters).
  CHECK(sum / n == doctest::Approx(1).epsilon(0.005));
}
