// SPDX-License-Identifier: Apache-2.0
// What mms furnace says of phase functions, in numbers and as a plot.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using nlohmann::json;

TEST_CASE(
    "furnace: phase functions, what is lost and gained, how efficient; the plot and the page") {
  const Folder folder;
  folder.write("s.mms",
               "surface fog scattering = 0; end\n"
               "volume fog scattering = 1; phase = 0.75 * henyey_greenstein(0.5); end\n"
               "surface bright bsdf = matte(0.6) + matte(0.6); end\n");
  const Outcome run = folder.mms(
      "furnace -Wno-non-conserving --samples=500 --format=json --plot=p.svg --page=p.md "
      "s.mms");
  INFO(run.err);
  REQUIRE(run.exit == 0);
  const json all = json::parse(run.out).at("surfaces");
  REQUIRE(all.size() == 2);
  for (const json& f : all) {
    const bool fog = f.at("form") == "volume";
    CHECK(f.at("surface") == (fog ? "fog" : "bright"));
    CHECK(f.at("rows").size() == (fog ? 1 : 10));
    // Both are sampled ideally: every sample weighs the albedo.
    CHECK(f.at("most_lost").get<double>() == doctest::Approx(fog ? 0.25 : 0).epsilon(1e-9));
    CHECK(f.at("most_gained").get<double>() == doctest::Approx(fog ? 0 : 0.2).epsilon(1e-9));
    CHECK(f.at("least_efficiency").get<double>() == doctest::Approx(1).epsilon(1e-9));
    CHECK(f.at("reciprocity_error").get<double>() < 1e-12);
    for (const json& row : f.at("rows"))
      CHECK(row.at("lost").get<double>() == doctest::Approx(fog ? 0.25 : -0.2).epsilon(1e-9));
  }
  const std::string svg = folder.read("p.svg"), text = folder.read("p.md");
  CHECK(contains(svg, "volume fog"));
  CHECK(contains(svg, "albedo over nm"));
  CHECK(contains(svg, "efficiency over degrees"));
  CHECK(contains(text, "\n## bright\n\n![bright](images/materials/bright.png)"));
  CHECK(contains(text, "| lost | -0.2000 |"));
}
