// SPDX-License-Identifier: Apache-2.0
// docs/materials.md has an entry, a picture and a script for every model of materials/lobes.def;
// and what mms furnace says of phase functions, in numbers and as a plot.
#include <filesystem>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/source_dir.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using mms::cli::project_text;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

}  // namespace

TEST_CASE("every model is in the figures, on the page and in a picture") {
  const std::string script = project_text("examples/figures/materials.mms");
  const std::string page = project_text("docs/materials.md");
  std::istringstream table(project_text("materials/lobes.def"));
  const std::string mark = "\"material ";
  std::uintmax_t bytes = 0;
  int models = 0;
  for (std::string line; std::getline(table, line);) {
    if (!line.starts_with("LOBE(")) continue;
    const std::size_t begin = line.find(mark) + mark.size();
    const std::string name = line.substr(begin, line.find('(', begin) - begin);
    INFO(name);
    CHECK(contains(script, "\nsurface " + name));
    CHECK(contains(page, "\n## " + name + "\n"));
    const fs::path picture = mms::source_dir() / "docs/images/materials" / (name + ".png");
    REQUIRE(fs::exists(picture));
    bytes += fs::file_size(picture);
    ++models;
  }
  CHECK(models >= 31);
  CHECK(bytes < 500'000);
  const Folder folder;
  const std::string path = mms::source_dir().string() + "/examples/figures/materials.mms";
  CHECK(folder.mms("check " + path).exit == 0);
  CHECK(folder.mms("fmt --check " + path).exit == 0);
}

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
