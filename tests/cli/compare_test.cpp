// SPDX-License-Identifier: Apache-2.0
// mms compare, and what pictures say of themselves.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

#if MMS_RENDERER

TEST_CASE("compare tells how pictures differ, and ends with 5 above the threshold") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  const std::string render = "render s.mms --quiet --size 40x30 --samples 16 ";
  for (const char* options : {"-o a.exr", "-o b.exr --seed 1", "-o a.png"})
    REQUIRE(folder.mms(render + options).exit == 0);
  Outcome run = folder.mms("compare a.exr b.exr --format=json");
  REQUIRE(run.exit == 0);
  const auto json = nlohmann::json::parse(run.out);
  const double rmse = json["rmse"].get<double>();
  CHECK(rmse > 0);
  // Two pictures of one scene, each as far from the truth as it says: the estimate is of one.
  CHECK(json["z"].get<double>() > 0.5);
  CHECK(json["z"].get<double>() < 2);
  CHECK(json["not_finite"] == 0);
  // One sample does not tell how far it is off.
  REQUIRE(folder.mms("render s.mms --quiet --size 40x30 --samples 1 -o one.exr").exit == 0);
  CHECK_FALSE(
      nlohmann::json::parse(folder.mms("compare one.exr a.exr --format=json").out).contains("z"));
  // A picture and itself; a .png holds what the .exr shows, to half a step of eight bits.
  run = folder.mms("compare a.exr a.exr --threshold 0");
  CHECK(run.exit == 0);
  run = folder.mms("compare a.exr a.png --measure rmse-shown --threshold 0.00196 --format=json");
  INFO(run.out, run.err);
  CHECK(run.exit == 0);
  // Above and below.
  run = folder.mms("compare a.exr b.exr --threshold " + std::to_string(rmse * 0.9));
  CHECK(run.exit == 5);
  CHECK(contains(run.err, "a.exr: rmse is"));
  run = folder.mms("compare a.exr b.exr --quiet --threshold " + std::to_string(rmse * 1.1));
  CHECK(run.exit == 0);
  CHECK(run.out == "");
}

TEST_CASE("compare draws the difference, and compares layers and parts") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  folder.write("t.mms", "surface \"s\" bsdf = matte(0.25); end\n");
  const std::string options = " --quiet --size 32x32 --samples 4 -o ";
  REQUIRE(folder.mms("render s.mms" + options + "s.exr").exit == 0);
  REQUIRE(folder.mms("render t.mms" + options + "t.exr").exit == 0);
  REQUIRE(folder.mms("compare s.exr t.exr -o d.png").exit == 0);
  REQUIRE(folder.mms("compare s.exr t.exr -o d.exr").exit == 0);
  CHECK(folder.read("d.png").substr(1, 3) == "PNG");
  CHECK(folder.has("d.exr"));
  // The ball's albedo is another; its place is not.
  CHECK(folder.mms("compare s.exr t.exr --layer position --threshold 0").exit == 0);
  CHECK(folder.mms("compare s.exr t.exr --layer descriptor --threshold 0").exit == 0);
  const Outcome run =
      folder.mms("compare s.exr t.exr --layer albedo --crop 15,15,2,2 --format=json");
  REQUIRE(run.exit == 0);
  // 0.25 in each channel, but for the wavelengths that four samples drew, the same in both.
  CHECK(nlohmann::json::parse(run.out)["rmse"].get<double>() == doctest::Approx(0.25).epsilon(0.1));
}

TEST_CASE("what cannot be compared says why") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  folder.write("text.png", "no picture");
  REQUIRE(folder.mms("render s.mms --quiet --size 8x8 --samples 1 -o a.exr").exit == 0);
  REQUIRE(folder.mms("render s.mms --quiet --size 8x9 --samples 1 -o b.exr").exit == 0);
  REQUIRE(folder.mms("render s.mms --quiet --size 8x8 --samples 1 -o a.film").exit == 0);
  const struct {
    const char* args;
    int exit;
    const char* what;
  } cases[] = {{"a.exr none.exr", 3, "none.exr"},
               {"a.exr text.png", 3, "text.png"},
               {"a.exr b.exr", 3, "sizes differ: 8x8 and 8x9"},
               {"a.film a.exr", 3, "a.film: is a film, exact sums, not a picture\n  = help: make"},
               {"a.exr a.film", 3, "mms merge A.film -o A.exr"},
               {"a.exr a.exr --layer albdo", 3, "albedo"},
               {"a.exr a.exr --crop 1,2,3", 2, "--crop"},
               {"a.exr a.exr --crop 4,4,5,1", 2, "the picture is 8x8"},
               {"a.exr a.exr --threshold -1", 2, "--threshold"},
               {"a.exr a.exr --view acse", 2, "acse"},
               {"a.exr a.exr --view ocio --ocio none.ocio", 3, "none.ocio"},
               {"a.exr a.exr -o d.gif", 3, "d.gif"}};
  for (const auto& c : cases) {
    CAPTURE(c.args);
    const Outcome run = folder.mms("compare " + std::string(c.args));
    CHECK(run.exit == c.exit);
    CHECK(contains(run.err, c.what));
    CHECK(contains(run.err, "error: "));
  }
}

#endif
