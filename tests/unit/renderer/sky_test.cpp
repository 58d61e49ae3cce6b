// SPDX-License-Identifier: Apache-2.0
// Skies against the formulas of the standard, written here once more, and environments by name.
#include "renderer/sky.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "materials/colour.h"
#include "materials/spectra.h"
#include "renderer/environments.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr double kTurn = 6.283185307179586;

/// The standard's L / Lz for altitude and azimuth of the place and of the sun, radians.
double type_1(double altitude, double, double, double) {
  return (1 + 4 * std::exp(-0.7 / std::sin(altitude))) / (1 + 4 * std::exp(-0.7));
}
double type_12(double altitude, double azimuth, double sun_altitude, double sun_azimuth) {
  const double cosine =
      std::sin(altitude) * std::sin(sun_altitude) +
      std::cos(altitude) * std::cos(sun_altitude) * std::cos(azimuth - sun_azimuth);
  const double chi = std::acos(std::min(1.0, cosine)), zenith_chi = kTurn / 4 - sun_altitude;
  const auto around_sun = [](double angle) {
    return 1 + 10 * (std::exp(-3 * angle) - std::exp(-3 * kTurn / 4)) +
           0.45 * std::pow(std::cos(angle), 2);
  };
  return (1 - std::exp(-0.32 / std::sin(altitude))) * around_sun(chi) /
         ((1 - std::exp(-0.32)) * around_sun(zenith_chi));
}
using Formula = double (*)(double, double, double, double);

/// What a white surface facing up sees, over pi: by the midpoint rule, even in the cosine squared.
double mean_over_cosine(Formula f, double sun_altitude, double sun_azimuth) {
  const int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      sum += f(std::asin(std::sqrt((i + 0.5) / n)), kTurn * k / n, sun_altitude, sun_azimuth);
  return sum / n / n;
}

const Sky& sky_named(std::string_view name) {
  for (const Sky& s : skies())
    if (s.name == name) return s;
  FAIL("no such sky");
  return skies()[0];
}

Result<SceneData> patch_under(const vm::Program& p, const std::string& environment) {
  SceneSource source;
  source.environment = environment;
  return parse_scene(p, source, patch(""), "test", "");
}

}  // namespace

TEST_CASE("skies are the standard's, and light a white ground to radiance 1") {
  const struct {
    const char* name;
    Formula formula;
    double altitude, azimuth;  // of the sun, degrees; the azimuth from -z towards +x
  } cases[] = {{"overcast", type_1, 40, 0},
               {"clear", type_12, 42, -153},
               {"clear", type_12, 15, 80},
               {"clear", type_12, 75, 200}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    CAPTURE(c.altitude);
    const double altitude = c.altitude * kTurn / 360, azimuth = c.azimuth * kTurn / 360;
    const Vec3d sun = Vec3d{std::cos(altitude) * std::sin(azimuth), std::sin(altitude),
                            -std::cos(altitude) * std::cos(azimuth)} *
                      7.0;
    const Sky& sky = sky_named(c.name);
    const EnvironmentImage image = make_sky(sky, sun);
    // The picture sums over texels of 0.7 degrees, where the brightness around the sun, which bends
    // most, has second derivatives of a hundred times itself: 100 (0.0123)^2 / 24 is below 1e-3.
    const double zenith = 1 / mean_over_cosine(c.formula, altitude, azimuth);
    double least = 1e9, most = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; x += 8) {
        const auto& texel = image.rgb[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
        const double up = (0.5 - (y + 0.5) / image.height) * kTurn / 2;
        if (y == image.height / 2) {  // repeats the row above
          CHECK(texel == image.rgb[std::size_t(y - 1) * std::size_t(image.width) + std::size_t(x)]);
          continue;
        }
        if (up < 0) {
          CHECK(texel == std::array<float, 3>{0.2f, 0.2f, 0.2f});
          continue;
        }
        const double expected =
            zenith * c.formula(up, ((x + 0.5) / image.width - 0.5) * kTurn, altitude, azimuth);
        for (std::size_t k = 0; k < 3; ++k) {
          least = std::min(least, texel[k] / sky.colour[k] / expected);
          most = std::max(most, texel[k] / sky.colour[k] / expected);
        }
      }
    CHECK(least == doctest::Approx(1).epsilon(1e-3));
    CHECK(most / least - 1 < 1e-6);  // ratios of luminance: but for rounding to float
  }
}

TEST_CASE("an overcast sky is three times as bright at the zenith as at the horizon") {
  const EnvironmentImage image = make_sky(sky_named("overcast"), kSun);
  const auto row = [&](int y) {
    return double(image.rgb[std::size_t(y) * std::size_t(image.width)][1]);
  };
  // 1 + 4 exp(-0.7) = 2.99, where the traditional overcast sky, (1 + 2 sin) / 3, has 3. In between
  // the two are different skies.
  CHECK(row(0) / row(image.height / 2 - 1) == doctest::Approx(3).epsilon(0.01));
}

TEST_CASE("a sky's light has luminance 1 and the colour that is stated, as a spectrum") {
  const auto seen = [](const Rgb& c) {
    return materials::xyz_of_spectrum([&](double nm) {
      const double r = materials::rgb_red(nm), g = materials::rgb_green(nm);
      return (c[0] * r + c[1] * g + c[2] * (1 - (r + g))) * materials::illuminant_d65(nm) /
             materials::illuminant_d65_luminance();
    });
  };
  // CIE 015: chromaticities of the D series above 7000 K. Colours are given to four digits.
  const double t = 15000;
  const double x = -2.0064e9 / (t * t * t) + 1.9018e6 / (t * t) + 0.24748e3 / t + 0.23704;
  const double y = -3 * x * x + 2.87 * x - 0.275;
  const Vec3d clear = seen(sky_named("clear").colour);
  CHECK(clear.y == doctest::Approx(1).epsilon(1e-4));
  CHECK(clear.x == doctest::Approx(x / y).epsilon(1e-4));
  CHECK(clear.z == doctest::Approx((1 - x - y) / y).epsilon(1e-4));
  CHECK(sky_named("overcast").colour == Rgb{1, 1, 1});
}

TEST_CASE("a ground of albedo 0.6 has luminance 0.6 under every bright environment") {
  HandProgram h;
  h.matte("ground", 0.6);
  for (const NamedEnvironment& e : kEnvironments) {
    CAPTURE(e.name);
    const Result<SceneData> s = patch_under(h.program, std::string(e.name));
    REQUIRE(bool(s));
    const Rendered r = run(h.program, Scene(std::make_shared<const SceneData>(*s)),
                           options(32, kSanitized ? 32 : 256));
    if (e.name == "black")
      CHECK(mean_luminance(r.film).value == 0);
    else
      check_mean(r.film, 0.6);
  }
}

TEST_CASE("a white ball vanishes in a white environment, whatever the scene's own") {
  HandProgram h;
  h.matte("ball", 1);
  const auto film = [&](const std::string& environment) {
    SceneSource source;
    source.name = "furnace";
    source.environment = environment;
    const Result<Scene> s = load_scene(h.program, source);
    REQUIRE(bool(s));
    RenderOptions o = options(32, kSanitized ? 8 : 64);
    return run(h.program, *s, o).film;
  };
  check_mean(film("white"), 1);
  CHECK(mean_luminance(film("black")).value == 0);
}

TEST_CASE("an environment that is asked for is part of the scene's hash") {
  HandProgram h;
  h.matte("ball", 0.5);
  const auto hash = [&](const std::string& environment) {
    SceneSource source;
    source.environment = environment;
    const Result<Scene> s = load_scene(h.program, source);
    REQUIRE_MESSAGE(bool(s), environment);
    return s->data().hash;
  };
  const auto folder = std::filesystem::temp_directory_path() / "mms_sky_test";
  std::filesystem::create_directories(folder);
  const auto picture = [&](const char* name, const char* header) {
    std::ofstream(folder / name) << header << "abcdefghijkl";
    return (folder / name).string();
  };
  const std::string one = picture("one.ppm", "P6 4 1 255\n");
  const std::string same = picture("same.ppm", "P6 4 1 255\n");
  const std::string other = picture("other.ppm", "P6 2 2 255\n");
  std::set<std::uint64_t> all{hash(""), hash(one), hash(other)};
  for (const NamedEnvironment& e : kEnvironments) all.insert(hash(std::string(e.name)));
  CHECK(all.size() == 3 + std::size(kEnvironments));
  CHECK(hash(one) == hash(same));
  std::filesystem::remove_all(folder);
}

TEST_CASE("an environment that is not there: a name that nothing has, or a file") {
  HandProgram h;
  h.matte("ground", 0.5);
  Result<SceneData> s = patch_under(h.program, "claer");
  REQUIRE_FALSE(bool(s));
  CHECK(s.error().where == "--environment");
  CHECK(s.error().what == "no environment `claer`");
  CHECK(s.error().hint.find("did you mean `clear`? ") == 0);
  for (const NamedEnvironment& e : kEnvironments)
    CHECK(s.error().hint.find("`" + std::string(e.name) + "`") != std::string::npos);
  CHECK(s.error().cause == Error::Cause::Name);
  s = patch_under(h.program, "claer.exr");
  REQUIRE_FALSE(bool(s));
  CHECK(s.error().cause == Error::Cause::File);
}
