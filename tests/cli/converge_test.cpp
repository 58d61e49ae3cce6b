// SPDX-License-Identifier: Apache-2.0
// mms converge: error against samples and time.
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

#if MMS_RENDERER

namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    rows.emplace_back();
    for (std::string cell; std::getline(in, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace

TEST_CASE("converge measures what it is asked for, and draws it") {
  const Folder folder;
  // A paper lantern: its outside is lit through its inside.
  folder.write("s.mms", "surface \"s\" bsdf = translucent(0.9); end\n");
  const Outcome run = folder.mms(
      "converge s.mms --samples 2:32 --reference 256 --with 'size=24x24 scene=furnace seed=3' "
      "--vary filter=box --vary 'filter=box max-depth=1' -o c.csv");
  INFO(run.out, run.err);
  REQUIRE(run.exit == 0);
  const auto rows = rows_of(folder.read("c.csv"));
  REQUIRE(rows.size() == 11);
  CHECK(rows[0][0] == "switches");
  CHECK(rows[0][4] == "rmse");
  CHECK(rows[1][0] == "filter=box");
  CHECK(rows[6][0] == "filter=box max-depth=1");
  for (int i = 0; i < 5; ++i) CHECK(rows[std::size_t(i) + 1][1] == std::to_string(2 << i));
  const auto error = [&](std::size_t row) { return std::stod(rows[row][4]); };
  // Sixteen times the samples: a quarter of the error at most, but for a fifth that the stated
  // error is known to.
  CHECK(error(5) < error(1) / 4 * 1.2);
  // Without light that is scattered twice it is another picture, which has a reference of its own.
  CHECK(error(10) < error(6) / 4 * 1.2);
  const std::string svg = folder.read("c.svg");
  CHECK(svg.starts_with("<svg "));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(contains(svg, "filter=box max-depth=1"));
  CHECK(contains(svg, "slope -"));
  CHECK(folder.file_count() == 3);
}

TEST_CASE("converge says what it cannot do") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  const struct {
    const char *args, *what;
  } cases[] = {{"--samples 8:4", "--samples"},
               {"--samples x", "--samples"},
               {"--reference 0", "--reference"},
               {"s.mms", "2 are given"},
               {"--with 'size=8x8 watch'", "`watch`"},
               {"--vary turntable=3", "`turntable`"},
               {"-o c.txt", ".csv"}};
  for (const auto& c : cases) {
    CAPTURE(c.args);
    const Outcome run = folder.mms("converge s.mms " + std::string(c.args));
    CHECK(run.exit == 2);
    CHECK(contains(run.err, c.what));
  }
  const Outcome run = folder.mms("converge s.mms --samples 1:1 --with size=8x8 --vary filter=bx");
  CHECK(run.exit == 2);
  CHECK(contains(run.err, "--filter=bx"));
  // What is wrong with the script is said as `mms render` says it.
  folder.write("bad.mms", "surface \"s\" bsdf = mate(0.5); end\n");
  const Outcome bad = folder.mms("converge bad.mms");
  const Outcome render = folder.mms("render bad.mms");
  CHECK(bad.exit == 1);
  CHECK(contains(render.err, "mate"));
  CHECK(contains(bad.err, render.err));
  CHECK(contains(folder.mms("converge bad.mms --format=json").out,
                 folder.mms("render bad.mms --format=json").out));
  CHECK(folder.mms("converge none.mms").exit == 3);
  const Outcome nowhere = folder.bash("TMPDIR=/no/such mms converge s.mms");
  CHECK(nowhere.exit == 3);
  CHECK(contains(nowhere.err, "no folder for temporary files"));
  CHECK(contains(nowhere.err, "TMPDIR"));
}

TEST_CASE("converge tells what will not do before it has rendered anything") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  const std::string small = "converge s.mms --samples 1:1 --with size=8x8 ";
  const Outcome late = folder.mms(small + "--vary filter=box --vary filter=bx");
  CHECK(late.exit == 2);
  CHECK(late.out == "");
  const Outcome nowhere = folder.mms(small + "-o no/such.csv");
  CHECK(nowhere.exit == 3);
  CHECK(nowhere.out == "");
  CHECK(contains(nowhere.err, "no folder `no`"));
}

TEST_CASE("converge writes nothing over what its pictures are made from") {
  const Folder folder;
  const std::string lamp = "400 1\n700 2\n";
  folder.write("lamp.csv", lamp);
  folder.write("s.mms", "surface \"s\" emission = measured(\"lamp.csv\", $wavelength); end\n");
  folder.write("plain.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  const std::string small = " --samples 1:1 --with size=8x8 -o ";
  for (const std::string& args : {"s.mms" + small + "lamp.csv", "s.mms" + small + "./lamp.csv"}) {
    CAPTURE(args);
    const Outcome run = folder.mms("converge " + args);
    CHECK(run.exit == 2);
    CHECK(contains(run.err, "lamp.csv: would be written over what it is made from"));
    CHECK(run.out == "");
  }
  // The plot too, and of any curve.
  REQUIRE(folder.bash("ln -s scene.json plot.svg").exit == 0);
  folder.write("scene.json", R"({"objects": [{"sphere": {}, "test": true}]})");
  const Outcome plot = folder.mms("converge plain.mms" + small +
                                  "plot.csv --vary scene=furnace --vary scene=scene.json");
  CHECK(plot.exit == 2);
  CHECK(contains(plot.err, "plot.svg: would be written over"));
  CHECK(folder.read("lamp.csv") == lamp);
  CHECK_FALSE(folder.has("plot.csv"));
}

TEST_CASE("converge reads its script from standard input, and quotes what holds commas") {
  const Folder folder;
  const Outcome run = folder.mms(
      "converge - --samples 1:2 --with size=8x8 --vary 'set=c=rgb(0.1,0.2,0.3)' -o c.csv",
      "param spectrum c = 0.5;\nsurface \"s\" bsdf = matte(c); end\n");
  INFO(run.err);
  CHECK(run.exit == 0);
  CHECK(contains(folder.read("c.csv"), "\n\"set=c=rgb(0.1,0.2,0.3)\",2,"));
}

TEST_CASE("Ctrl-C ends a measurement with a table of what is there, and leaves nothing running") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  // The signal goes to the command alone, while it waits for a render that takes hours.
  const Outcome run = folder.bash(R"BASH(
mkdir tmp; touch log
TMPDIR=$PWD/tmp mms-render converge s.mms --samples 1:1048576 --reference 1 --with size=32x32 -o c.csv \
  >log 2>err & child=$!
for i in $(seq 3000); do
  grep -q ' 8 samples' log && break; sleep 0.01
done
kill -INT $child; wait $child; echo "ended $?"; cat err; ls tmp
)BASH");
  INFO(run.out, run.err);
  CHECK(contains(run.out, "ended 130\nstopped: c.csv has what was there, "));
  CHECK(run.out.ends_with(" renders\n"));
  const auto rows = rows_of(folder.read("c.csv"));
  REQUIRE(rows.size() > 4);
  CHECK(rows[4][1] == "8");
  CHECK(folder.has("c.svg"));
}

#endif
