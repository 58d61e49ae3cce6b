// SPDX-License-Identifier: Apache-2.0
// How a linear picture is shown: the thesis' curve, plain sRGB, an OpenColorIO view.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "materials/colour.h"
#include "materials/spectra.h"
#include "renderer/picture.h"

using namespace mms;
using namespace mms::renderer;

namespace {

namespace fs = std::filesystem;

/// Figure 6.3: a colour, each patch 1.25 times as bright as the one before.
constexpr int kPatches = 24;
Film patches(double kelvin) {
  const Vec3d colour =
      materials::xyz_of_spectrum([&](double nm) { return materials::planck(nm, kelvin); });
  Film film{kPatches, 1, {}, {}};
  double y = 0.05;
  for (int i = 0; i < kPatches; ++i, y *= 1.25) {
    const Vec3d xyz = colour * (y / colour.y);
    film.xyz.push_back({xyz.x, xyz.y, xyz.z});
    film.variance.push_back(0);
  }
  return film;
}

std::array<int, 3> pixel(const std::vector<unsigned char>& bytes, int i) {
  return {bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2]};
}

double luminance(const std::array<int, 3>& p) {
  const auto linear = [](int v) { return materials::srgb_decode(v / 255.0); };
  return materials::xyz_of_linear_srgb({linear(p[0]), linear(p[1]), linear(p[2])}).y;
}

/// A configuration with the role that OpenColorIO 2 defines for XYZ, or with a named linear space.
std::string configuration(bool role) {
  return std::string("ocio_profile_version: 2\nsearch_path: \"\"\nroles:\n  default: base\n") +
         (role ? "  cie_xyz_d65_interchange: base\n" : "") + R"(displays:
  screen:
    - !<View> {name: half, colorspace: halved}
    - !<View> {name: plain, colorspace: base}
colorspaces:
  - !<ColorSpace>
    name: base
  - !<ColorSpace>
    name: halved
    from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
)" + (role ? "" : "  - !<ColorSpace>\n    name: lin_srgb\n");
}

struct Configuration {
  fs::path path = fs::temp_directory_path() / "mms_view_test.ocio";
  explicit Configuration(bool role) { std::ofstream(path) << configuration(role); }
  ~Configuration() { fs::remove(path); }
};

}  // namespace

TEST_CASE("Figure 6.3: desaturation fades to white, clamping stays red however bright") {
  const Film red = patches(1500), grey = patches(6600);
  const auto faded = display_pixels(red, {});
  const auto cut = display_pixels(red, {.curve = Curve::Srgb});
  REQUIRE(bool(faded));
  REQUIRE(bool(cut));
  for (int i = 1; i < kPatches; ++i) {
    CHECK(luminance(pixel(*faded, i)) >= luminance(pixel(*faded, i - 1)));
    // What is mapped is luminance, exactly but for eight bits: half a step of the steepest channel.
    const double y = materials::map_luminance(red.xyz[std::size_t(i)][1], 1.7, 1);
    CHECK(std::abs(luminance(pixel(*faded, i)) - y) < 0.005);
    CHECK(pixel(*cut, i)[2] == 0);
  }
  const auto [r, g, b] = pixel(*faded, kPatches - 1);
  CHECK((r >= 253 && g >= 253 && b >= 253));
  // Dark patches are as red as they can be; the brightest that is only cut has no blue, so never
  // more than the luminance of yellow.
  CHECK(pixel(*faded, 0)[2] < pixel(*faded, 0)[0] / 4);
  CHECK(luminance(pixel(*cut, kPatches - 1)) < 0.93);
  // Grey is grey by both: 6600 K is a shade bluer than the white of sRGB.
  for (const Curve curve : {Curve::Thesis, Curve::Srgb}) {
    const auto shown = display_pixels(grey, {.curve = curve});
    REQUIRE(bool(shown));
    for (int i = 0; i < kPatches; ++i) {
      const auto p = pixel(*shown, i);
      CHECK(std::abs(p[0] - p[1]) < 9);
      CHECK(std::abs(p[2] - p[1]) < 9);
    }
  }
}

TEST_CASE("plain sRGB encodes what is there, by stops, and cuts the rest") {
  Film film{3, 1, {}, {0, 0, 0}};
  for (const double v : {0.25, 1.5, -1.0}) {
    const Vec3d xyz = materials::xyz_of_linear_srgb({v, v, v});
    film.xyz.push_back({xyz.x, xyz.y, xyz.z});
  }
  const auto plain = display_pixels(film, {.curve = Curve::Srgb});
  REQUIRE(bool(plain));
  CHECK(pixel(*plain, 0) == std::array{137, 137, 137});  // IEC 61966-2-1 of 0.25: 136.96
  CHECK(pixel(*plain, 1) == std::array{255, 255, 255});
  CHECK(pixel(*plain, 2) == std::array{0, 0, 0});
  const auto brighter = display_pixels(film, {.curve = Curve::Srgb, .exposure = 1});
  REQUIRE(bool(brighter));
  CHECK(pixel(*brighter, 0) == std::array{188, 188, 188});  // of 0.5: 187.52
}

TEST_CASE("an OpenColorIO view is found by name and shows its numbers") {
  Film film{2, 1, {{0.4, 0.6, 0.2}, {0, 0, 0}}, {0, 0}};
  for (const bool role : {true, false}) {
    CAPTURE(role);
    const Configuration file(role);
    View view{.curve = Curve::OpenColorIO, .config = file.path.string()};
    view.view = "half";
    const auto half = display_pixels(film, view);
    REQUIRE_MESSAGE(bool(half), (half ? "" : half.error().what));
    // With the role XYZ goes in, else linear sRGB; half of it comes out.
    const Vec3d in = role ? Vec3d{0.4, 0.6, 0.2} : materials::linear_srgb_of_xyz({0.4, 0.6, 0.2});
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs((*half)[std::size_t(k)] - 255 * std::clamp(in[k] / 2, 0.0, 1.0)) < 0.51);
    CHECK(pixel(*half, 1) == std::array{0, 0, 0});
    view.view = "halves";
    const auto wrong = display_pixels(film, view);
    REQUIRE_FALSE(bool(wrong));
    CHECK(wrong.error().hint.find("plain") != std::string::npos);
  }
  const auto none = display_pixels(film, {.curve = Curve::OpenColorIO, .config = "/no/such.ocio"});
  REQUIRE_FALSE(bool(none));
  CHECK(none.error().where == "/no/such.ocio");
}
