// SPDX-License-Identifier: Apache-2.0
// mms.h as a host uses it: thesis Algorithm 6.2 as printed, and what its surface is worth.
#include "api/mms.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "linked.h"

extern "C" int heights_from_c(float* heights);

namespace {

using mms::api::Linked;

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A folder that is gone at the end, and the current one while it lives.
class WorkingFolder {
 public:
  WorkingFolder() {
    std::filesystem::create_directories(here_);
    std::filesystem::current_path(here_);
  }
  ~WorkingFolder() {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(here_);
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
  std::filesystem::path here_ = before_ / "mms_api_test_files";
};

const char* const kMySurface =
    "surface \"mysurf\"\n"
    "  bsdf = matte(marble_albedo(0.25));\n"
    "  scattering = 0.75;\n"
    "  height = $position[0] * $position[1];\n"
    "  gradient = [$position[1], 3.0];\n"
    "end\n";
const char* const kMarble = "real marble_albedo(real x) = 2 * x;\n";

/// What the surface of Algorithm 6.2 must evaluate to.
void check_surface(const MMsProgram& program, const Surface& surface) {
  // 1000 points: more than a batch, and no multiple of one.
  constexpr std::size_t kCount = 1000;
  std::vector<float> position(3 * kCount), height(kCount), gradient(2 * kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    position[i] = static_cast<float>(i);
    position[kCount + i] = 0.5f;
  }
  const MMsInput input{"position", position.data()};
  const MMsPoints points{kCount, &input, 1};
  MMsContext* context = mmsMkContext(program);
  REQUIRE(context);
  REQUIRE(mmsEvalSurface(context, &surface, "height", &points, height.data()));
  REQUIRE(mmsEvalSurface(context, &surface, "gradient", &points, gradient.data()));
  for (std::size_t i = 0; i < kCount; ++i) {
    CHECK(height[i] == 0.5f * static_cast<float>(i));
    CHECK(gradient[i] == 0.5f);
    CHECK(gradient[kCount + i] == 3.0f);
  }
  std::vector<float> scattering(8 * kCount);
  REQUIRE(mmsEvalSurface(context, &surface, "scattering", &points, scattering.data()));
  for (const float s : scattering) CHECK(s == 0.75f);

  // A matte surface of albedo 0.5: f = 0.5 / pi, pdf = cos / pi, at any wavelength.
  const float wo[3] = {0, 0, 1}, wi[3] = {0.6f, 0, 0.8f};
  const MMsPoints one{1, nullptr, 0};
  float f[8], pdf[8];
  REQUIRE(mmsEvalBsdf(context, &surface, &one, wo, wi, f));
  REQUIRE(mmsPdfBsdf(context, &surface, &one, wo, wi, pdf));
  for (int c = 0; c < 8; ++c) {
    CHECK(f[c] == doctest::Approx(0.5 / std::numbers::pi).epsilon(1e-6));
    CHECK(pdf[c] == doctest::Approx(0.8 / std::numbers::pi).epsilon(1e-6));
  }
  mmsDeleteContext(context);
}

}  // namespace

TEST_CASE("Algorithm 6.2 compiles as printed, and its surface evaluates") {
  const WorkingFolder folder;
  std::ofstream("marble.txt") << kMarble;
  const std::string script = kMySurface;

  // clang-format off
  MMsGraph* g1 = mmsMkGraph();
  MMsGraph* g2 = mmsMkGraph();
  if (!mmsParseString(*g1, script)) throw Error(mmsGetGraphLog(*g1));
  if (!mmsParseFile(*g2, "marble.txt")) throw Error(mmsGetGraphLog(*g2));
  MMsProgram* p = mmsMkProgram();
  mmsAddGraph(*p, *g1);
  mmsAddGraph(*p, *g2);
  if (!mmsLinkProgram(*p, mms::O2)) throw Error(mmsGetProgramLog(*p));
  Surface* s = mmsGetSurface(*p, "mysurf");
  if (!s) throw Error("No surface description \"mysurf\" exist.");
  check_surface(*p, *s);  // ... constructed surface can be used here
  mmsDeleteProgram(p);
  mmsDeleteGraph(g2);
  mmsDeleteGraph(g1);
  // clang-format on
}

TEST_CASE("the header works from C") {
  float heights[2];
  REQUIRE(heights_from_c(heights));
  CHECK(heights[0] == 0.25f);
  CHECK(heights[1] == 0.5f);
}

TEST_CASE("every level gives the same numbers") {
  for (const int level : {mms::O0, mms::O1, mms::O2}) {
    MMsGraph* graph = mmsMkGraph();
    MMsProgram* program = mmsMkProgram();
    REQUIRE(mmsParseString(*graph, std::string(kMySurface) + kMarble));
    REQUIRE(mmsAddGraph(*program, *graph));
    mmsDeleteGraph(graph);  // the program has a copy
    REQUIRE(mmsLinkProgram(*program, level));
    REQUIRE(mmsGetSurface(*program, "mysurf"));
    check_surface(*program, *mmsGetSurface(*program, "mysurf"));
    mmsDeleteProgram(program);
  }
}

TEST_CASE("samples of a matte surface are cosine-distributed and weigh its albedo") {
  const Linked linked("surface \"m\" bsdf = matte(0.25); end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  constexpr std::size_t kSide = 64, kCount = kSide * kSide;
  std::vector<float> wo(3 * kCount), u(3 * kCount), wi(3 * kCount), f(8 * kCount), pdf(8 * kCount);
  std::vector<unsigned char> flags(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    wo[2 * kCount + i] = 1;
    u[i] = 0.5f;
    u[kCount + i] = (static_cast<float>(i % kSide) + 0.5f) / kSide;
    u[2 * kCount + i] = (static_cast<float>(i / kSide) + 0.5f) / kSide;
  }
  const MMsPoints points{kCount, nullptr, 0};
  REQUIRE(mmsSampleBsdf(linked.context, mmsGetSurface(linked.program, "m"), &points, wo.data(),
                        u.data(), wi.data(), f.data(), pdf.data(), flags.data()));
  double mean_cosine = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    REQUIRE(flags[i] == MMS_SAMPLED);
    const double z = wi[2 * kCount + i];
    mean_cosine += z / kCount;
    // Rounding of the quotient: three operations in float.
    CHECK(f[i] * z / pdf[i] == doctest::Approx(0.25).epsilon(1e-5));
  }
  // The mean of the cosine under cos / pi is 2/3. The midpoint rule meets a square root at the rim:
  // with h = 1/32 in radius it errs by 2 sqrt(2) 0.061 h^1.5 = 0.001.
  CHECK(std::abs(mean_cosine - 2.0 / 3.0) < 0.0015);
}

TEST_CASE("a volume's numbers") {
  const Linked linked("volume \"v\" scattering = $distance; absorption = 2; end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  MMsVolume* volume = mmsGetVolume(linked.program, "v");
  REQUIRE(volume);
  const float distance = 7;
  const MMsInput input{"distance", &distance};
  const MMsPoints points{1, &input, 1};
  float values[8];
  REQUIRE(mmsEvalVolume(linked.context, volume, "scattering", &points, values));
  for (const float v : values) CHECK(v == 7.0f);
  REQUIRE(mmsEvalVolume(linked.context, volume, "absorption", &points, values));
  for (const float v : values) CHECK(v == 2.0f);
}

TEST_CASE("a spectrum is evaluated at the wavelengths that are given") {
  const Linked linked("surface \"s\" emission = $wavelength * 2; end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsSurface* surface = mmsGetSurface(linked.program, "s");
  float metres[8], values[8];
  for (int c = 0; c < 8; ++c) metres[c] = 1e-7f * static_cast<float>(c + 4);
  const MMsInput input{"wavelength", metres};
  const MMsPoints points{1, &input, 1};
  REQUIRE(mmsEvalSurface(linked.context, surface, "emission", &points, values));
  for (int c = 0; c < 8; ++c) CHECK(values[c] == 2 * metres[c]);
}

TEST_CASE("mistakes are told in the logs") {
  MMsGraph* graph = mmsMkGraph();
  CHECK_FALSE(mmsParseString(*graph, "surface \"s\" bsdf = ; end"));
  CHECK(std::string(mmsGetGraphLog(*graph)).find("<string>:1:") != std::string::npos);
  MMsProgram* program = mmsMkProgram();
  CHECK_FALSE(mmsAddGraph(*program, *graph));
  CHECK(std::string(mmsGetProgramLog(*program)) != "");

  CHECK_FALSE(mmsParseFile(*graph, "no/such/file.mms"));
  CHECK(std::string(mmsGetGraphLog(*graph)).find("no/such/file.mms") != std::string::npos);

  REQUIRE(mmsParseString(*graph, "surface \"s\" height = no_such_name; end"));
  CHECK(std::string(mmsGetGraphLog(*graph)) == "");
  REQUIRE(mmsAddGraph(*program, *graph));
  CHECK_FALSE(mmsLinkProgram(*program, mms::O2));
  CHECK(std::string(mmsGetProgramLog(*program)).find("no_such_name") != std::string::npos);
  CHECK_FALSE(mmsLinkProgram(*program, 3));
  CHECK(mmsMkContext(*program) == nullptr);
  CHECK(mmsGetSurface(*program, "s") == nullptr);
  mmsDeleteProgram(program);
  mmsDeleteGraph(graph);
}

TEST_CASE("evaluation says what it cannot do") {
  const Linked linked("surface \"s\" height = 1; end");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsSurface* surface = mmsGetSurface(linked.program, "s");
  const float lane[3] = {};
  float value[8];
  const MMsInput wrong{"positoin", lane};
  const MMsPoints one{1, nullptr, 0}, bad{1, &wrong, 1};
  const auto log = [&] { return std::string(mmsGetContextLog(linked.context)); };
  CHECK_FALSE(mmsEvalSurface(linked.context, surface, "heigth", &one, value));
  CHECK(log().find("heigth") != std::string::npos);
  CHECK_FALSE(mmsEvalSurface(linked.context, surface, "bsdf", &one, value));
  CHECK(log().find("bsdf") != std::string::npos);
  CHECK_FALSE(mmsEvalSurface(linked.context, surface, "height", &bad, value));
  CHECK(log().find("position") != std::string::npos);
  CHECK(mmsEvalSurface(linked.context, surface, "height", &one, value));
  CHECK(value[0] == 1.0f);
  CHECK(log() == "");
}

TEST_CASE("bounds enclose an output over a box, and say what is wrong with a bad one") {
  const Linked linked(
      "surface \"s\" height = $position[0] * $position[0]; scattering = rgb(0.25, 0.5, 0.75); end\n"
      "volume \"v\" absorption = 2 + $object_position[2]; end\n");
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsSurface* surface = mmsGetSurface(linked.program, "s");
  float lo[2] = {}, hi[2] = {};
  const auto log = [&] { return std::string(mmsGetContextLog(linked.context)); };
  REQUIRE(mmsBoundSurface(linked.context, surface, "height", nullptr, 0, 1, lo, hi));
  CHECK(lo[0] == 0.0f);
  CHECK(hi[0] == 1.0f);
  const float from[] = {2, -1, -1}, to[] = {3, 1, 1};
  const MMsInterval box{"position", from, to};
  REQUIRE(mmsBoundSurface(linked.context, surface, "height", &box, 1, 4, lo, hi));
  CHECK(lo[0] == 4.0f);
  CHECK(hi[0] == 9.0f);
  REQUIRE(mmsBoundSurface(linked.context, surface, "scattering", nullptr, 0, 1, lo, hi));
  CHECK(lo[0] <= 0.25f);
  CHECK(hi[0] >= 0.75f);
  REQUIRE(mmsBoundVolume(linked.context, mmsGetVolume(linked.program, "v"), "absorption", nullptr,
                         0, 1, lo, hi));
  CHECK(lo[0] == 1.0f);
  CHECK(hi[0] == 3.0f);

  const MMsInterval unknown{"positoin", from, to}, backwards{"position", to, from};
  CHECK_FALSE(mmsBoundSurface(linked.context, surface, "height", &unknown, 1, 1, lo, hi));
  CHECK(log().find("position") != std::string::npos);
  CHECK_FALSE(mmsBoundSurface(linked.context, surface, "height", &backwards, 1, 1, lo, hi));
  CHECK(log().find("no interval") != std::string::npos);
  CHECK_FALSE(mmsBoundSurface(linked.context, surface, "bsdf", nullptr, 0, 1, lo, hi));
  CHECK(log().find("bsdf") != std::string::npos);
}

TEST_CASE("a null handle fails quietly") {
  MMsGraph* graph = nullptr;
  CHECK(mmsParseString(graph, "") == 0);
  CHECK(mmsLinkProgram(static_cast<MMsProgram*>(nullptr), 0) == 0);
  CHECK(std::string(mmsGetGraphLog(graph)) == "");
  CHECK(mmsMkContext(static_cast<const MMsProgram*>(nullptr)) == nullptr);
  mmsDeleteGraph(nullptr);
  mmsDeleteProgram(nullptr);
  mmsDeleteContext(nullptr);
}

TEST_CASE("two programs in one process know nothing of each other") {
  const Linked a("param real k = 1; surface \"s\" height = k; end");
  const Linked b("param real k = 2; surface \"s\" height = k; end");
  REQUIRE_MESSAGE(a.context, a.log);
  REQUIRE_MESSAGE(b.context, b.log);
  const MMsPoints one{1, nullptr, 0};
  float from_a = 0, from_b = 0;
  REQUIRE(mmsEvalSurface(a.context, mmsGetSurface(a.program, "s"), "height", &one, &from_a));
  REQUIRE(mmsEvalSurface(b.context, mmsGetSurface(b.program, "s"), "height", &one, &from_b));
  CHECK(from_a == 1.0f);
  CHECK(from_b == 2.0f);
}
