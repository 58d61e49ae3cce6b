// SPDX-License-Identifier: Apache-2.0
// Every output of a descriptor from outside, and what a program says of itself.
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "linked.h"

namespace {

using mms::api::Linked;
constexpr double kPi = std::numbers::pi;
const MMsPoints kOne{1, nullptr, 0};

}  // namespace

TEST_CASE("a phase function is evaluated and drawn from") {
  const Linked linked("volume v phase = henyey_greenstein($distance); scattering = 1; end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsVolume* v = mmsGetVolume(linked.program, "v");
  constexpr std::size_t kSide = 32, kCount = kSide * kSide;
  const double g = 0.5;
  std::vector<float> distance(kCount, 0.5f), wo(3 * kCount), u(3 * kCount), wi(3 * kCount),
      f(8 * kCount), pdf(8 * kCount), again(8 * kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    wo[kCount + i] = 1;
    u[kCount + i] = (static_cast<float>(i % kSide) + 0.5f) / kSide;
    u[2 * kCount + i] = (static_cast<float>(i / kSide) + 0.5f) / kSide;
  }
  const MMsInput input{"distance", distance.data()};
  const MMsPoints points{kCount, &input, 1};
  std::vector<unsigned char> flags(kCount);
  REQUIRE(mmsSamplePhase(linked.context, v, &points, wo.data(), u.data(), wi.data(), f.data(),
                         pdf.data(), flags.data()));
  double mean = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    REQUIRE(flags[i] == MMS_SAMPLED);
    const double c = -double(wi[kCount + i]);  // of the deflection: wo points back along y
    mean += c / kCount;
    const double hg = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * c, 1.5));
    CHECK(f[i] == doctest::Approx(hg).epsilon(1e-5));
    CHECK(pdf[i] == doctest::Approx(hg).epsilon(1e-5));
  }
  // The mean cosine is g. The inverse of the distribution is smooth: the midpoint rule over 32
  // strata errs by h^2 |f''| / 24 < 1e-3 where |f''| < 24.
  CHECK(std::abs(mean - g) < 1e-3);
  REQUIRE(mmsEvalPhase(linked.context, v, &points, wo.data(), wi.data(), again.data()));
  CHECK(again == f);
  REQUIRE(mmsPdfPhase(linked.context, v, &points, wo.data(), wi.data(), again.data()));
  CHECK(again == pdf);
}

TEST_CASE("the shape of emission") {
  const Linked linked(
      "surface front emission = 2; end\n"
      "surface behind emission = 2; emission_function = translucent(0.5); end\n"
      "volume even emission = 1; end\n"
      "volume beam emission = 1; emission_function = henyey_greenstein(0.5); end\n");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const float up[3] = {0, 0, 1}, down[3] = {0, 0, -1}, y[3] = {0, 1, 0};
  float shape[8];
  const auto surface = [&](const char* name, const float* w) {
    REQUIRE(mmsEvalSurfaceEmission(linked.context, mmsGetSurface(linked.program, name), &kOne, w,
                                   shape));
    return shape[7];
  };
  const auto volume = [&](const char* name, const float* w) {
    REQUIRE(
        mmsEvalVolumeEmission(linked.context, mmsGetVolume(linked.program, name), &kOne, w, shape));
    return shape[7];
  };
  CHECK(surface("front", up) == doctest::Approx(1).epsilon(1e-6));
  CHECK(surface("front", down) == 0.0f);
  CHECK(surface("behind", up) == 0.0f);
  CHECK(surface("behind", down) == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(volume("even", up) == doctest::Approx(1).epsilon(1e-6));
  CHECK(volume("even", down) == doctest::Approx(1).epsilon(1e-6));
  // Towards y, light that came from y has turned back: (1 - g^2) / (1 + g)^3 = 2/9.
  CHECK(volume("beam", y) == doctest::Approx(0.75 / 3.375).epsilon(1e-5));
}

TEST_CASE("constants and functions without arguments have values at every point") {
  const Linked linked(
      "const half = 0.5;\nreal[3] twice() = 2 * $position;\ncomplex z() = complex($uv[0], half);\n"
      "spectrum s() = $wavelength * 1e9;\nlogic inside() = $position[0] < 0.5;\n"
      "integer n() = integer($position[1]);\nreal with(real x) = x;\n");
  REQUIRE_MESSAGE(linked.context, linked.log);
  std::string all;
  MMsValueInfo info;
  for (std::size_t k = 0; mmsGetValue(linked.program, k, &info); ++k)
    all += std::string(info.type) + " " + info.name + " " + std::to_string(info.size) + "; ";
  for (const char* one : {"real half 1; ", "real[3] twice 3; ", "complex z 2; ", "spectrum s 8; ",
                          "logic inside 1; ", "integer n 1; "})
    CHECK_MESSAGE(all.find(one) != std::string::npos, one, " in ", all);
  CHECK(all.find("with") == std::string::npos);

  const float position[6] = {0.25f, 0.75f, 3, -4, 5, 6}, uv[4] = {0.125f, 1, 2, 3};
  const MMsInput inputs[] = {{"position", position}, {"uv", uv}};
  const MMsPoints two{2, inputs, 2};
  float out[16];
  REQUIRE(mmsEvalValue(linked.context, "twice", &two, out));
  for (int i = 0; i < 6; ++i) CHECK(out[i] == 2 * position[i]);
  REQUIRE(mmsEvalValue(linked.context, "z", &two, out));
  CHECK(std::vector(out, out + 4) == std::vector{0.125f, 1.0f, 0.5f, 0.5f});
  REQUIRE(mmsEvalValue(linked.context, "s", &two, out));
  CHECK(out[0] == doctest::Approx(400).epsilon(1e-6));
  CHECK(out[15] == doctest::Approx(750).epsilon(1e-6));
  REQUIRE(mmsEvalValue(linked.context, "inside", &two, out));
  CHECK(std::vector(out, out + 2) == std::vector{1.0f, 0.0f});
  REQUIRE(mmsEvalValue(linked.context, "n", &two, out));
  CHECK(std::vector(out, out + 2) == std::vector{3.0f, -4.0f});
  CHECK_FALSE(mmsEvalValue(linked.context, "with", &two, out));
  CHECK(std::string(mmsGetContextLog(linked.context)).find("with") != std::string::npos);
}

TEST_CASE("params are listed as an authoring tool wants them, and take other values") {
  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();
  REQUIRE(mmsParseString(graph,
                         "/// How coarse.\n"
                         "param real scale = 4.0 in [0.1, 20], label = \"Scale\", unit = \"mm\", "
                         "page = \"Shape\";\n"
                         "param real[3] tint = [1, 0.5, 0.25];\n"
                         "surface s height = scale * tint[1]; end"));
  REQUIRE(mmsAddGraph(program, graph));
  mmsDeleteGraph(graph);
  MMsParamInfo p;
  CHECK_FALSE(mmsGetParam(program, 0, &p));
  const auto height = [&] {
    float value = -1;
    REQUIRE(mmsLinkProgram(program, 2));
    MMsContext* context = mmsMkContext(static_cast<const MMsProgram*>(program));
    CHECK(mmsEvalSurface(context, mmsGetSurface(program, "s"), "height", &kOne, &value));
    mmsDeleteContext(context);
    return value;
  };
  CHECK(height() == 2.0f);
  REQUIRE(mmsGetParam(program, 0, &p));
  CHECK(std::string(p.name) == "scale");
  CHECK(std::string(p.type) == "real");
  CHECK(std::string(p.label) == "Scale");
  CHECK(std::string(p.unit) == "mm");
  CHECK(std::string(p.page) == "Shape");
  CHECK(std::string(p.doc).find("How coarse.") != std::string::npos);
  REQUIRE(p.value_count == 1);
  CHECK(p.values[0] == 4.0);
  CHECK(p.has_range);
  CHECK(p.lower == 0.1);
  CHECK(p.upper == 20.0);
  REQUIRE(mmsGetParam(program, 1, &p));
  REQUIRE(p.value_count == 3);
  CHECK(p.values[2] == 0.25);
  CHECK_FALSE(p.has_range);
  CHECK_FALSE(mmsGetParam(program, 2, &p));
  for (const char* value : {"6.0", "2 * 5"}) CHECK(mmsSetParam(program, "scale", value));
  CHECK(height() == 5.0f);  // the later one
  CHECK(mmsSetParam(program, "scael", "1"));
  CHECK_FALSE(mmsLinkProgram(program, 2));
  CHECK(std::string(mmsGetProgramLog(program)).find("scale") != std::string::npos);
  mmsDeleteProgram(program);
}

TEST_CASE("a program knows of every output what it depends on") {
  const Linked linked(
      "surface a bsdf = matte(rgb($uv[0], 0, 0)); height = 2 * $position[2]; end\n"
      "surface b emission = 1; end volume c absorption = $distance; end\n");
  REQUIRE_MESSAGE(linked.context, linked.log);
  CHECK(std::string(mmsGetSurfaceName(linked.program, 0)) == "a");
  CHECK(std::string(mmsGetSurfaceName(linked.program, 1)) == "b");
  CHECK(mmsGetSurfaceName(linked.program, 2) == nullptr);
  CHECK(std::string(mmsGetVolumeName(linked.program, 0)) == "c");
  MMsOutputInfo info;
  const auto reads = [&] {
    std::string names;
    for (unsigned k = 0; k < 32; ++k)
      if (info.variables >> k & 1u) names += std::string(mmsGetVariableName(k)) + " ";
    return names;
  };
  const MMsSurface* a = mmsGetSurface(linked.program, "a");
  REQUIRE(mmsGetSurfaceOutput(a, "bsdf", &info));
  CHECK(info.stated);
  CHECK_FALSE(info.constant);
  CHECK(info.spectral);
  CHECK(reads() == "uv wavelength ");
  REQUIRE(mmsGetSurfaceOutput(a, "height", &info));
  CHECK_FALSE(info.spectral);
  CHECK(reads() == "position ");
  REQUIRE(mmsGetSurfaceOutput(mmsGetSurface(linked.program, "b"), "emission", &info));
  CHECK(info.constant);
  CHECK(reads() == "");
  REQUIRE(mmsGetSurfaceOutput(a, "absorption", &info));
  CHECK_FALSE(info.stated);
  REQUIRE(mmsGetVolumeOutput(mmsGetVolume(linked.program, "c"), "absorption", &info));
  CHECK(reads() == "distance ");
  CHECK_FALSE(mmsGetSurfaceOutput(a, "phase", &info));
  CHECK(mmsGetVariableName(1000) == nullptr);
  CHECK(mmsGetVariableSize("position") == 3);
  CHECK(mmsGetVariableSize("wavelength") == 8);
  CHECK(mmsGetVariableSize("footprint") == 4);
  CHECK(mmsGetVariableSize("rgb_red") == 0);
  CHECK(mmsGetOutputSize("gradient") == 2);
  CHECK(mmsGetOutputSize("absorption") == 8);
  CHECK(mmsGetOutputSize("phase") == 0);
  CHECK(std::strlen(mmsGetVersion()) >= 5);
}

TEST_CASE("a gradient that is derived needs the changes along the tangents, which may be given") {
  const Linked linked("surface s height = $object_position[0] + 3 * $object_position[1]; end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsSurface* s = mmsGetSurface(linked.program, "s");
  float gradient[2];
  REQUIRE(mmsEvalSurface(linked.context, s, "gradient", &kOne, gradient));
  CHECK(gradient[0] == 1.0f);
  CHECK(gradient[1] == 3.0f);
  const float tangent[3] = {0.5f, 0.5f, 0};
  const MMsInput input{"object_tangent", tangent};
  const MMsPoints points{1, &input, 1};
  REQUIRE(mmsEvalSurface(linked.context, s, "gradient", &points, gradient));
  CHECK(gradient[0] == 2.0f);
}

TEST_CASE("what a context was asked before changes no value") {
  const Linked linked(
      "surface coated bsdf = coat(microfacet(1, 0.3), dielectric(1.5, 0.2 + 0.1 * $time)); end\n"
      "surface filmed bsdf = film_mix(matte(0.5), microfacet(1, 0.3), 1.5, 1.38, 300nm * $time,\n"
      "    $wavelength); end\n"
      "surface rough bsdf = dielectric(1.3 + 0.2 * $time, 0.4); end\n");
  REQUIRE_MESSAGE(linked.context, linked.log);
  // Points in pairs of the same numbers, along other directions.
  const float time[4] = {1, 1, 2, 2};
  const float wo[12] = {0, 0.6f, 0.6f, 0.28f, 0, 0, 0, 0, 1, 0.8f, 0.8f, 0.96f};
  const float wi[12] = {0.6f, 0, -0.28f, 0, 0, 0.6f, 0, 0.6f, 0.8f, 0.8f, 0.96f, -0.8f};
  const float u[12] = {0.1f, 0.4f, 0.6f, 0.9f, 0.2f, 0.5f, 0.7f, 0.3f, 0.8f, 0.1f, 0.4f, 0.6f};
  const MMsInput input{"time", time};
  const MMsPoints points{4, &input, 1};
  /// All that scatters: f, densities, and a sample's direction, f and density.
  const auto asked = [&](MMsContext* context, const char* name) {
    const MMsSurface* s = mmsGetSurface(linked.program, name);
    std::vector<float> all(4 * (8 + 8 + 3 + 8 + 8));
    float *f = all.data(), *pdf = f + 32, *drawn = pdf + 32, *f_drawn = drawn + 12;
    unsigned char flags[4];
    REQUIRE(mmsEvalBsdf(context, s, &points, wo, wi, f));
    REQUIRE(mmsPdfBsdf(context, s, &points, wo, wi, pdf));
    REQUIRE(mmsSampleBsdf(context, s, &points, wo, u, drawn, f_drawn, f_drawn + 32, flags));
    return all;
  };
  for (const char* name : {"coated", "filmed", "rough", "coated", "rough", "filmed"}) {
    CAPTURE(name);
    MMsContext* fresh = mmsMkContext(linked.program);
    const auto kept = asked(linked.context, name), alone = asked(fresh, name);
    mmsDeleteContext(fresh);
    CHECK(kept == alone);
    CHECK(kept[0] > 0);
    CHECK(kept[32] > 0);
  }
}
