// SPDX-License-Identifier: Apache-2.0
// What a render says of itself: its error, its light, and the options of the picture.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using nlohmann::json;

#if MMS_RENDERER

namespace {

constexpr const char* kMatte = "surface \"s\" bsdf = matte(0.5); end\n";

/// What `mms render s.mms ARGS` says, as JSON.
json report(const Folder& folder, const std::string& args) {
  const Outcome run = folder.mms("render s.mms --format=json " + args);
  INFO(args, run.err);
  REQUIRE(run.exit == 0);
  return json::parse(run.out);
}

}  // namespace

TEST_CASE("the error of one sample is not known, and nothing says that it is") {
  const Folder folder;
  folder.write("s.mms", kMatte);
  const std::string one = "--size 16x16 --samples 1 -o one.exr";
  CHECK_FALSE(report(folder, one).contains("error"));
  CHECK(contains(folder.mms("render s.mms " + one).out, "estimated error unknown"));
  CHECK_FALSE(contains(folder.read("one.exr"), "mms:error"));
  CHECK(report(folder, "--size 16x16 --samples 1 -o a.film").at("samples") == 1);
  const Outcome merged = folder.mms("merge a.film -o a.exr");
  CHECK(contains(merged.out, "estimated error unknown"));
  CHECK_FALSE(json::parse(folder.mms("merge a.film -o a.exr --format=json").out).contains("error"));
  CHECK(report(folder, "--size 16x16 --samples 2 -o two.exr").at("error") > 0);
  CHECK(contains(folder.read("two.exr"), "mms:error"));
  REQUIRE(folder.mms("converge s.mms --samples 1:2 --with size=8x8 -o c.csv").exit == 0);
  // switches, samples, seconds, and an empty cell
  const std::string csv = folder.read("c.csv");
  const std::string row = csv.substr(csv.find("\ndefault,1,") + 1);
  CHECK(contains(row.substr(0, row.find('\n')), ",,"));
  CHECK(csv.find(",,") == csv.rfind(",,"));
}

TEST_CASE("no time is too short for a sample of each pixel") {
  const Folder folder;
  folder.write("s.mms", kMatte);
  CHECK(report(folder, "--time 0.000001 --size 100x60 -o t.exr").at("samples") >= 1);
  CHECK(report(folder, "--time 0.000001 --error 0.001 --size 100x60 -o t.exr").at("samples") >= 1);
}

TEST_CASE(
    "a picture that ends by its error says how many samples it took, and goes on to the same") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = dielectric(1.5); end\n");
  const std::string options = "--size 64x48 --filter box --error 0.04 ";
  const json whole = report(folder, options + "-o whole.film");
  CHECK(whole.at("error") <= 0.04);
  CHECK(whole.at("mean_samples") > whole.at("samples"));
  const json even = report(folder, "--size 16x16 --samples 3 -o even.png");
  CHECK(even.at("mean_samples") == 3);
  const std::string text = folder.mms("render s.mms " + options + "-o text.png").out;
  CHECK(contains(text, " or more, "));
  CHECK(contains(text, " on average, "));
  // Cut short, then resumed.
  report(folder, options + "--time 0.000001 -o part.film");
  CHECK(folder.read("part.film") != folder.read("whole.film"));
  report(folder, options + "--resume -o part.film");
  CHECK(folder.read("part.film") == folder.read("whole.film"));
}

TEST_CASE("light that is too bright is told from light that is not finite") {
  const Folder folder;
  const auto said = [&](const std::string& emission) {
    folder.write("s.mms", "surface \"s\" emission = " + emission + "; end\n");
    const Outcome run = folder.mms("render s.mms --scene furnace --size 8x8 --samples 4 -o a.exr");
    CHECK(run.exit == 0);
    return run.err;
  };
  // Radiance of 1 is white, by and large; sums have room for 2^32 of it, squares for 2^19.
  CHECK(said("1e5") == "");
  const std::string cut = said("1e8");
  CHECK(contains(cut, "brighter than 5.2e+05 times white"));
  CHECK(contains(cut, "stated error"));
  CHECK_FALSE(contains(cut, "left out"));
  const std::string bright = said("1e12");
  CHECK(contains(bright, "samples were too bright (4.3e+09 times white is the most)"));
  CHECK_FALSE(contains(bright, "not finite"));
  CHECK(contains(said("1 / ($position[0] * 0)"), "samples were not finite and were left out"));
}

TEST_CASE("a picture names its sampler, its estimator and the numbers of its samples") {
  const Folder folder;
  folder.write("s.mms", kMatte);
  const std::string render =
      "render s.mms --quiet --size 16x16 --sampler sobol --estimator four --samples ";
  REQUIRE(folder.mms(render + "0:4 -o a.film").exit == 0);
  REQUIRE(folder.mms(render + "8:16 -o b.film").exit == 0);
  REQUIRE(folder.mms("merge a.film b.film -o sum.png").exit == 0);
  const std::string png = folder.read("sum.png");
  for (const char* name :
       {"mms:sampler", "sobol", "mms:estimator", "four", "mms:sample_numbers", "0:4 8:16"})
    CHECK_MESSAGE(contains(png, name), name);
}

TEST_CASE("a material that varies and adds up to more than 1 is told, and where") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\"\n    bsdf = matte(0.8) + mirror($uv.x);\nend\n");
  const Outcome run = folder.mms("render s.mms --size 16x16 --samples 4 -o a.png");
  CHECK(run.exit == 0);
  CHECK(contains(run.err, "s.mms:1: the weights of `s`'s material add up to more than 1 at "));
  CHECK(contains(run.err, "= help: "));
  const json gain = report(folder, "--size 16x16 --samples 4 -o a.png").at("gains").at(0);
  CHECK(gain.at("descriptor") == "s");
  CHECK(gain.at("most") > 1);
  CHECK(gain.at("points") < gain.at("of"));
}

#endif
