// SPDX-License-Identifier: Apache-2.0
// stdlib/openpbr.mms as a script uses it: what it keeps in a white furnace, and that no setting of
// its params gives anything but light.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/sanitized.h"
#include "tests/sums.h"
#include "tests/unit/api/linked.h"

namespace mms::api {
namespace {

/// `import "openpbr";` with these params, linked.
struct OpenPbr : Linked {
  explicit OpenPbr(const Settings& settings, int level = O2)
      : Linked("import \"openpbr\"; paint alias openpbr;", level, settings) {}
  MMsSurface* surface() const { return mmsGetSurface(program, "paint"); }
};

/// The weights of samples along one direction, at the first wavelength.
struct Weights {
  double mean = 0, error = 0;  ///< `error`: standard, were the samples independent
  int bad = 0;                 ///< numbers that are not finite or negative, densities that are 0
};

/// The digits of `i` in `base`, mirrored at the point: Halton's sequence.
float mirrored_digits(std::size_t i, std::size_t base) {
  double value = 0, digit = 1;
  for (; i > 0; i /= base) value += (digit /= double(base)) * double(i % base);
  return std::min(float(value), 0x1.fffffep-1f);
}

/// By points of Halton's sequence, which spread more evenly than independent ones: means err by
/// less than `error`. What crosses counts as radiance where the relative index is `ior`.
Weights weights(const OpenPbr& p, double cosine, std::size_t count, double ior = 1) {
  const float wavelengths[8] = {550e-9f, 430e-9f, 470e-9f, 510e-9f,
                                590e-9f, 630e-9f, 670e-9f, 710e-9f};
  std::vector<float> wo(3 * count), u(3 * count), wi(3 * count), f(8 * count), pdf(8 * count),
      metres(8 * count);
  std::vector<unsigned char> flags(count);
  constexpr std::size_t kBases[3] = {2, 3, 5};
  for (std::size_t i = 0; i < count; ++i) {
    wo[i] = float(0.8 * std::sqrt(1 - cosine * cosine));
    wo[count + i] = float(0.6 * std::sqrt(1 - cosine * cosine));
    wo[2 * count + i] = float(cosine);
    for (std::size_t k = 0; k < 3; ++k) u[k * count + i] = mirrored_digits(i + 1, kBases[k]);
    for (std::size_t c = 0; c < 8; ++c) metres[c * count + i] = wavelengths[c];
  }
  const MMsInput input{"wavelength", metres.data()};
  const MMsPoints points{count, &input, 1};
  Weights w;
  if (!mmsSampleBsdf(p.context, p.surface(), &points, wo.data(), u.data(), wi.data(), f.data(),
                     pdf.data(), flags.data()))
    return {0, 0, 1};
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(flags[i] & MMS_SAMPLED)) continue;
    for (std::size_t c = 0; c < 8; ++c)
      w.bad += !(std::isfinite(f[c * count + i]) && f[c * count + i] >= 0) ||
               !(std::isfinite(pdf[c * count + i]) && pdf[c * count + i] >= 0);
    w.bad += !(pdf[i] > 0);
    const double z = wi[2 * count + i], crosses = z < 0 ? ior * ior : 1;
    const double weight = crosses * double(f[i]) * std::abs(z) / double(pdf[i]);
    sum += weight;
    squares += weight * weight;
  }
  w.mean = sum / double(count);
  w.error = std::sqrt(std::max(0.0, squares / double(count) - w.mean * w.mean) / double(count));
  return w;
}

TEST_CASE("openpbr: its lossless settings keep all light" * kSum) {
  const struct {
    const char* what;
    Settings settings;
    double lost;     ///< at most: what the models of it are known to lose (materials/combine.h)
    double ior = 1;  ///< that light is refracted by
  } cases[] = {
      {"opaque", {{"base_color", "spectrum(1.0)"}}, 1e-4},
      {"rough", {{"base_color", "spectrum(1.0)"}, {"specular_roughness", "0.9"}}, 1e-4},
      {"bare", {{"base_color", "spectrum(1.0)"}, {"specular_weight", "0"}}, 1e-5},
      {"metal", {{"base_color", "spectrum(1.0)"}, {"base_metalness", "1"}}, 1e-4},
      {"subsurface", {{"subsurface_weight", "1"}}, 1e-4},
      {"half of it",
       {{"base_color", "spectrum(1.0)"},
        {"subsurface_weight", "0.5"},
        {"specular_roughness", "0.6"}},
       1e-4},
      {"fuzz",
       {{"base_color", "spectrum(1.0)"}, {"specular_weight", "0"}, {"fuzz_weight", "1"}},
       1e-4},
      {"dusty metal",
       {{"base_color", "spectrum(1.0)"}, {"base_metalness", "1"}, {"fuzz_weight", "0.7"}},
       1e-4},
      {"varnish", {{"base_color", "spectrum(1.0)"}, {"coat_weight", "1"}}, 1e-4},
      {"rough varnish on brushed metal",
       {{"base_color", "spectrum(1.0)"},
        {"base_metalness", "1"},
        {"specular_roughness_anisotropy", "0.5"},
        {"coat_weight", "1"},
        {"coat_roughness", "0.4"}},
       1e-4},
      {"rough glass", {{"transmission_weight", "1"}, {"specular_roughness", "0.6"}}, 1e-3, 1.5},
      {"rough glass, varnished",
       {{"transmission_weight", "1"},
        {"specular_roughness", "0.4"},
        {"coat_weight", "1"},
        {"coat_roughness", "0.2"}},
       1e-3,
       1.5},
      {"pane",
       {{"geometry_thin_walled", "true"},
        {"transmission_weight", "1"},
        {"specular_roughness", "0"},
        {"specular_ior", "1.7"}},
       1e-5},
      {"frosted pane",
       {{"geometry_thin_walled", "true"}, {"transmission_weight", "1"}, {"specular_ior", "1.7"}},
       1e-4},
      {"frosted pane under a film",
       {{"geometry_thin_walled", "true"}, {"transmission_weight", "1"}, {"thin_film_weight", "1"}},
       3e-4},
      {"glass that is not specular",  // goes straight through
       {{"transmission_weight", "1"}, {"specular_weight", "0"}},
       1e-5},
      {"film on rough glass",
       {{"transmission_weight", "1"},
        {"specular_roughness", "0.6"},
        {"thin_film_weight", "1"},
        {"thin_film_ior", "1.9"}},
       1e-3,
       1.5},
      {"smooth film",
       {{"transmission_weight", "1"},
        {"specular_ior", "1"},
        {"specular_roughness", "0"},
        {"thin_film_weight", "1"},
        {"thin_film_ior", "1.33"}},
       1e-5},
      {"film on rough plastic",
       {{"base_color", "spectrum(1.0)"}, {"thin_film_weight", "1"}, {"thin_film_ior", "1.9"}},
       3e-4},
      {"half a film on rough plastic, varnished",
       {{"base_color", "spectrum(1.0)"}, {"thin_film_weight", "0.5"}, {"coat_weight", "1"}},
       3e-4},
  };
  const std::size_t count = kSanitized ? 1024 : 16384;
  for (const auto& c : cases) {
    INFO(c.what);
    const OpenPbr p(c.settings);
    REQUIRE_MESSAGE(p.context, p.log);
    for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
      INFO(cosine);
      const Weights w = weights(p, cosine, count, c.ior);
      CHECK(w.bad == 0);
      CHECK(std::abs(w.mean - 1) < c.lost + 5 * w.error + 1e-5);  // 1e-5: float
    }
  }
}

TEST_CASE("openpbr: params at the ends of their ranges give light, and no more than there was") {
  const OpenPbr defaults({});
  REQUIRE_MESSAGE(defaults.context, defaults.log);
  std::vector<Settings> all;
  MMsParamInfo info;
  for (std::size_t k = 0; mmsGetParam(defaults.program, k, &info); ++k) {
    const std::string name = info.name;
    if (std::string(info.type) == "spectrum")
      for (const char* value : {"spectrum(0.0)", "spectrum(1.0)", "rgb(1, 0, 0)"})
        all.push_back({{name, value}});
    if (!info.has_range) continue;
    for (const double end : {info.lower, info.upper}) all.push_back({{name, std::to_string(end)}});
  }
  CHECK(all.size() > 60);
  // And many at once: each layer there, with the others at either end.
  for (int k = 0; k < (kSanitized ? 4 : 16); ++k)
    all.push_back({{"base_metalness", k & 1 ? "0.5" : "0"},
                   {"transmission_weight", k & 2 ? "0.5" : "0"},
                   {"coat_weight", k & 4 ? "1" : "0.3"},
                   {"fuzz_weight", k & 8 ? "1" : "0.3"},
                   {"thin_film_weight", k & 1 ? "1" : "0"},
                   {"specular_roughness_anisotropy", k & 2 ? "1" : "0"},
                   {"specular_roughness", k & 4 ? "0" : "1"},
                   {"coat_roughness", k & 8 ? "0.5" : "0"},
                   {"transmission_dispersion_scale", k & 8 ? "1" : "0"},
                   {"geometry_thin_walled", k & 8 ? "true" : "false"},
                   {"subsurface_weight", k & 4 ? "0.7" : "0"},
                   {"base_color", "spectrum(1.0)"}});
  const std::size_t count = kSanitized ? 64 : 1024;
  for (const Settings& settings : all) {
    std::string what;
    for (const auto& [name, value] : settings) what += name + "=" + value + " ";
    INFO(what);
    const OpenPbr p(settings);
    REQUIRE_MESSAGE(p.context, p.log);
    for (const double cosine : {1.0, 0.3, 0.01}) {
      INFO(cosine);
      const Weights w = weights(p, cosine, count);
      CHECK(w.bad == 0);
      // From outside in, radiance is compressed by refraction: no weight above 1 in the mean.
      CHECK(w.mean < 1 + 3e-3 + 5 * w.error);
    }
  }
}

TEST_CASE("openpbr: highlights are those of GGX, whose alpha is the square of the roughness") {
  // Over a black base, near the mirror direction: F D G2 / (4 c c'), D and G2 as Walter et al.
  // (2007) and Heitz (2014) have them; the coat's index is 1.6, the base's 1.5.
  const auto ggx = [](double roughness, double c, double tilt) {
    // wo and wi at `tilt` to both sides of a half vector at cosine c to the normal, in one plane.
    const double a = roughness * roughness, angle = std::acos(c);
    const double zo = std::cos(angle + tilt), zi = std::cos(angle - tilt);
    const auto lambda = [&](double z) {
      return (std::sqrt(1 + a * a * (1 - z * z) / (z * z)) - 1) / 2;
    };
    const double d = a * a / (3.14159265358979 * std::pow(c * c * (a * a - 1) + 1, 2));
    return d / (1 + lambda(zo) + lambda(zi)) / (4 * zo * zi);
  };
  for (const bool coated : {false, true})
    for (const double roughness : {0.2, 0.3, 0.5}) {
      const std::string r = std::to_string(roughness);
      const OpenPbr p(coated ? Settings{{"base_weight", "0"},
                                        {"specular_weight", "0"},
                                        {"coat_weight", "1"},
                                        {"coat_roughness", r}}
                             : Settings{{"base_weight", "0"}, {"specular_roughness", r}});
      REQUIRE_MESSAGE(p.context, p.log);
      const double f0 = coated ? std::pow(0.6 / 2.6, 2) : 0.04;
      for (const double c : {1.0, 0.995, 0.98}) {
        const double tilt = 0.1, angle = std::acos(c);
        const float wavelengths[8] = {550e-9f, 430e-9f, 470e-9f, 510e-9f,
                                      590e-9f, 630e-9f, 670e-9f, 710e-9f};
        const MMsInput input{"wavelength", wavelengths};
        const MMsPoints points{1, &input, 1};
        const float wo[3] = {float(std::sin(angle + tilt)), 0, float(std::cos(angle + tilt))};
        const float wi[3] = {float(std::sin(angle - tilt)), 0, float(std::cos(angle - tilt))};
        float f[8];
        REQUIRE(mmsEvalBsdf(p.context, p.surface(), &points, wo, wi, f));
        // Fresnel's factor of angles below 20 degrees is f0 within 2 %; further bounces add less.
        CHECK(double(f[0]) == doctest::Approx(f0 * ggx(roughness, c, tilt)).epsilon(0.03));
      }
    }
}

/// f towards `wi` of light along a direction 37 degrees from the normal, at the first wavelength.
float value(const Linked& p, const std::array<float, 3>& wi) {
  const float wavelengths[8] = {550e-9f, 430e-9f, 470e-9f, 510e-9f,
                                590e-9f, 630e-9f, 670e-9f, 710e-9f};
  const MMsInput input{"wavelength", wavelengths};
  const MMsPoints points{1, &input, 1};
  const float wo[3] = {0.6f, 0, 0.8f};
  float f[8];
  REQUIRE_MESSAGE(p.context, p.log);
  REQUIRE(mmsEvalBsdf(p.context, mmsGetSurface(p.program, "paint"), &points, wo, wi.data(), f));
  return f[0];
}

constexpr std::array<float, 3> kReflected{-0.48f, 0.36f, 0.8f}, kTransmitted{-0.48f, 0.1f, -0.87f};

TEST_CASE("openpbr: a rough coat roughens what is below") {
  // A coat of index 1 is seen by that alone; 0.3^4 + 2 0.4^4 = 0.0593.
  for (const char* what : {"base_metalness", "transmission_weight"}) {
    INFO(what);
    const OpenPbr coated({{what, "1"},
                          {"specular_roughness", "0.3"},
                          {"coat_weight", "1"},
                          {"coat_ior", "1"},
                          {"coat_roughness", "0.4"}}),
        bare({{what, "1"}, {"specular_roughness", std::to_string(std::pow(0.0593, 0.25))}});
    CHECK(value(bare, kReflected) > 1e-3f);
    CHECK(value(coated, kReflected) == doctest::Approx(value(bare, kReflected)).epsilon(1e-4));
  }
}

TEST_CASE("openpbr: bumps of the base and of the coat move the highlight of that alone") {
  const std::string metal = "base_metalness = 1.0, specular_roughness = 0.3, coat_weight = 1.0",
                    varnish =
                        "base_weight = 0.0, specular_weight = 0.0, coat_weight = 1.0, "
                        "coat_roughness = 0.3";
  // 37 degrees from the normal, mirrored there and about the normal of the slope.
  const std::array<float, 3> here{-0.6f, 0, 0.8f}, there{-0.941f, 0, 0.338f};
  const auto seen = [](const std::string& of, const std::string& slope) {
    return Linked("surface paint bsdf = openpbr(" + of + slope + "); end", O2);
  };
  for (const auto& [of, slope, other] :
       {std::tuple{metal, ", base_slope = [0.3, 0]", ", coat_slope = [0.3, 0]"},
        std::tuple{varnish, ", coat_slope = [0.3, 0]", ", base_slope = [0.3, 0]"}}) {
    const Linked plain = seen(of, ""), bent = seen(of, slope), same = seen(of, other);
    CHECK(value(plain, here) > 10 * value(bent, here));
    CHECK(value(bent, there) > 10 * value(plain, there));
    CHECK(value(same, here) == doctest::Approx(value(plain, here)).epsilon(0.1));
  }
}

TEST_CASE("openpbr: clear matter is as rough as it is said to be, and tinted") {
  for (const bool thin : {false, true})
    for (const char* film : {"0", "0.5", "1"}) {
      INFO(thin, " ", film);
      const auto seen = [&](const char* roughness, const char* colour) {
        return OpenPbr({{"transmission_weight", "1"},
                        {"geometry_thin_walled", thin ? "true" : "false"},
                        {"thin_film_weight", film},
                        {"specular_roughness", roughness},
                        {"specular_color", colour},
                        {"transmission_color", colour}});
      };
      const OpenPbr polished = seen("0", "spectrum(1.0)"), rough = seen("0.6", "spectrum(1.0)"),
                    grey = seen("0.6", "spectrum(0.5)");
      for (const auto& wi : {kReflected, kTransmitted}) {
        CHECK(value(polished, wi) == 0);
        CHECK(value(rough, wi) > 1e-3f);
        CHECK(value(grey, wi) < 0.6f * value(rough, wi));
      }
    }
}

TEST_CASE("openpbr: a sheet that is all but clear reflects what a clear one does") {
  const double ior = 1.7;
  const OpenPbr p({{"geometry_thin_walled", "true"},
                   {"transmission_weight", "1"},
                   {"transmission_color", "spectrum(0.0)"},
                   {"specular_roughness", "0.01"},
                   {"specular_ior", std::to_string(ior)}});
  REQUIRE_MESSAGE(p.context, p.log);
  for (const double cosine : {1.0, 0.7, 0.5, 0.3}) {
    // Of each polarisation 2 R / (1 + R), by Fresnel's equations as they stand.
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const double s = (cosine - ior * inside) / (cosine + ior * inside),
                 t = (ior * cosine - inside) / (ior * cosine + inside);
    const double both = s * s / (1 + s * s) + t * t / (1 + t * t);
    const Weights w = weights(p, cosine, kSanitized ? 1024 : 16384);
    CHECK(std::abs(w.mean - both) < 0.01 * both + 5 * w.error);
  }
}

TEST_CASE("openpbr: every level of optimisation gives the same bits") {
  const Settings settings{{"base_color", "rgb(0.7, 0.3, 0.2)"},
                          {"base_metalness", "0.4"},
                          {"transmission_weight", "0.3"},
                          {"coat_weight", "0.7"},
                          {"fuzz_weight", "0.5"},
                          {"thin_film_weight", "0.5"}};
  const OpenPbr plain(settings, O0), best(settings, O2);
  REQUIRE_MESSAGE(plain.context, plain.log);
  REQUIRE_MESSAGE(best.context, best.log);
  for (const double cosine : {0.9, 0.2}) {
    const Weights a = weights(plain, cosine, 256), b = weights(best, cosine, 256);
    CHECK(a.mean == b.mean);
    CHECK(a.error == b.error);
    CHECK(a.bad + b.bad == 0);
  }
}

TEST_CASE("openpbr: what is not asked for is not there") {
  const OpenPbr p({});
  REQUIRE_MESSAGE(p.context, p.log);
  MMsOutputInfo info;
  REQUIRE(mmsGetSurfaceOutput(p.surface(), "emission", &info));
  CHECK(info.constant);
  CHECK(!info.spectral);
}

}  // namespace
}  // namespace mms::api
