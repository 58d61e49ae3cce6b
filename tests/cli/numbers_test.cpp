// SPDX-License-Identifier: Apache-2.0
// The verbs that look into a script's numbers: accuracy, profile, disasm, eval --trace.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using nlohmann::json;

namespace {

constexpr const char* kBumpy =
    "surface \"bumpy\"\n"
    "  height = 0.1 * sin(30.0 * $object_position[0])\n"
    "    + 0.01 * perlin(8.0 * $object_position);\n"
    "end\n";

}  // namespace

TEST_CASE("accuracy reports every varying output, as text and as JSON") {
  const Folder folder;
  folder.write("bumpy.mms", kBumpy);
  const Outcome text = folder.mms("accuracy --samples=200 bumpy.mms");
  INFO(text.err);
  CHECK(text.exit == 0);
  for (const char* part : {"surface bumpy height: 200 numbers", "ulp", "absolute",
                           "worst in ulp at [", "points a second in float"})
    CHECK_MESSAGE(contains(text.out, part), text.out);
  const Outcome run =
      folder.mms("accuracy --samples=200 --box=0,0,0,2,2,2 --format=json bumpy.mms");
  REQUIRE(run.exit == 0);
  const json report = json::parse(run.out);
  bool height = false, gradient = false;
  for (const json& o : report.at("outputs")) {
    height = height || o.at("output") == "height";
    gradient = gradient || o.at("output") == "gradient";
    CHECK(o.at("median_ulp").get<double>() <= o.at("worst_ulp").get<double>());
    for (const json& x : o.at("point")) CHECK((x >= 0 && x <= 2));
  }
  CHECK(height);
  CHECK(gradient);
  CHECK(report.at("speeds").size() >= 1);
}

TEST_CASE("accuracy refuses what is no number of points and no box") {
  const Folder folder;
  folder.write("bumpy.mms", kBumpy);
  for (const char* option : {"--samples=0", "--samples=many", "--box=1,2,3", "--box=1,1,1,0,0,0"}) {
    const Outcome run = folder.mms("accuracy bumpy.mms " + std::string(option));
    CHECK(run.exit == 2);
    CHECK(contains(run.err, std::string(option).substr(0, 5)));
    CHECK(contains(run.err, "help:"));
  }
}

TEST_CASE("profile tells the lines apart, and shows the script with their shares") {
  const Folder folder;
  folder.write("bumpy.mms", kBumpy);
  const Outcome run = folder.mms("profile --samples=2000 bumpy.mms");
  INFO(run.err);
  CHECK(run.exit == 0);
  for (const char* part : {"bumpy.mms:2", "bumpy.mms:3", "ns a point", "| + 0.01 * perlin("})
    CHECK_MESSAGE(contains(run.out, part), run.out);
  const Outcome lines = folder.mms("profile --samples=2000 --format=json bumpy.mms");
  double total = 0;
  for (const json& line : json::parse(lines.out)) total += line.at("share").get<double>();
  CHECK(total == doctest::Approx(1));
}

TEST_CASE("disasm shows bytecode, and lowered code with costs beside its source") {
  const Folder folder;
  folder.write("bumpy.mms", kBumpy);
  const Outcome run = folder.mms("disasm bumpy.mms");
  CHECK(run.exit == 0);
  for (const char* part : {"function 0", "PushInput", "lowered 0", "; bumpy.mms:3  + 0.01 * perlin",
                           "real perlin(real[3] p) of ", "$object_position[0]"})
    CHECK_MESSAGE(contains(run.out, part), run.out);
}

TEST_CASE("eval --trace prints the values on the way, and where a NaN was made") {
  const Folder folder;
  const Outcome run = folder.mms(
      "eval --trace --set position=[0,3,0] '2 * ($position.x / $position.z) + $position.y'");
  INFO(run.err);
  CHECK(run.exit == 0);
  for (const char* part :
       {"<expression>:1:", "DivR", "$position.y", "3\n", "was first made at <expression>:1:"})
    CHECK_MESSAGE(contains(run.out, part), run.out);
  CHECK(contains(run.out, "nan\n"));
  const Outcome fine = folder.mms(
      "eval --trace --precision=double --set position=[1,3,7] '$position.x / $position.z'");
  CHECK(contains(fine.out, "0.14285714285714285"));
  CHECK(!contains(fine.out, "first made"));
}

TEST_CASE("furnace tells what a surface gives back, as text, as JSON and as a plot") {
  const Folder folder;
  folder.write("grey.mms",
               "surface grey bsdf = matte(0.25); end\n"
               "surface clear bsdf = glass(bk7()); end\n");
  const Outcome text = folder.mms("furnace --samples=100 grey.mms");
  INFO(text.err);
  CHECK(text.exit == 0);
  for (const char* part : {"surface grey: loses at most 0.7500", "is reciprocal within",
                           "surface clear", "degrees", "550 nm"})
    CHECK_MESSAGE(contains(text.out, part), text.out);
  const Outcome run = folder.mms("furnace --samples=500 --plot=a.svg --format=json grey.mms");
  REQUIRE(run.exit == 0);
  const json report = json::parse(run.out);
  REQUIRE(report.at("surfaces").size() == 2);
  for (const json& row : report["surfaces"][0]["rows"]) {
    for (const json& a : row["albedo"]) CHECK(a.get<double>() == doctest::Approx(0.25));
    CHECK(row["relative_variance"].get<double>() < 1e-9);
  }
  // Smooth glass loses nothing, whatever the wavelength, from either side.
  CHECK(report["surfaces"][1]["rows"].size() > report["surfaces"][0]["rows"].size());
  for (const json& row : report["surfaces"][1]["rows"])
    for (const json& a : row["albedo"]) CHECK(a.get<double>() == doctest::Approx(1));
  CHECK(contains(folder.read("a.svg"), "<polyline"));
}

TEST_CASE("furnace refuses what has no surface, and no number of samples") {
  const Folder folder;
  folder.write("none.mms", "const x = 1;\n");
  const Outcome none = folder.mms("furnace none.mms");
  CHECK(none.exit == 1);
  CHECK(contains(none.err, "no surface"));
  const Outcome wrong = folder.mms("furnace --samples=few none.mms");
  CHECK(wrong.exit == 2);
  CHECK(contains(wrong.err, "--samples"));
}

TEST_CASE(
    "furnace says what it cannot write before it measures, and writes nothing over its script") {
  const Folder folder;
  const std::string script =
      "surface \"s\" bsdf = matte(measured(\"lamp.csv\", $wavelength)); end\n";
  const std::string lamp = "400 0.1\n700 0.2\n";
  folder.write("s.mms", script);
  folder.write("lamp.csv", lamp);
  for (const std::string option : {"--plot ", "--page "})
    for (const std::string output : {"s.mms", "lamp.csv"}) {
      CAPTURE(option + output);
      const Outcome over = folder.mms("furnace s.mms --samples 10 " + option + output);
      CHECK(over.exit == 2);
      CHECK(contains(over.err, output + ": would be written over"));
    }
  const Outcome nowhere = folder.mms("furnace s.mms --samples 10 --plot no/such.svg");
  CHECK(nowhere.exit == 3);
  CHECK(contains(nowhere.err, "no folder `no`"));
  CHECK(nowhere.out == "");
  CHECK(folder.read("s.mms") == script);
  CHECK(folder.read("lamp.csv") == lamp);
}
