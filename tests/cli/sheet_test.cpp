// SPDX-License-Identifier: Apache-2.0
// mms render of several pictures: contact sheets, sweeps, turntables.
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

#if MMS_RENDERER

namespace {

/// Width and height, of the IHDR chunk.
std::pair<int, int> size_of(const std::string& png) {
  REQUIRE(png.size() > 24);
  const auto number = [&](std::size_t at) {
    int n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n * 256 + static_cast<unsigned char>(png[at + i]);
    return n;
  };
  return {number(16), number(20)};
}

double difference(const Folder& folder, const std::string& args) {
  const Outcome run = folder.mms("compare --format=json " + args);
  INFO(args, run.err);
  REQUIRE(run.exit == 0);
  return nlohmann::json::parse(run.out)["rmse"].get<double>();
}

}  // namespace

TEST_CASE("several scripts and one .png make a contact sheet") {
  const Folder folder;
  folder.write("a.mms", "surface \"a\" bsdf = matte(0.1); end\n");
  folder.write("b.mms", "surface \"b\" bsdf = matte(0.8); end\n");
  folder.write("bad.mms", "surface \"c\" bsdf = mate(0.8); end\n");
  const std::string options = " --quiet --size 64x48 --samples 2 -o ";
  REQUIRE(folder.mms("render a.mms b.mms a.mms" + options + "sheet.png").exit == 0);
  REQUIRE(folder.mms("render a.mms" + options + "a.png").exit == 0);
  // Two columns and rows of 64 x 48, with margins and captions.
  const auto [width, height] = size_of(folder.read("sheet.png"));
  CHECK(width == 2 * (64 + 4) + 4);
  CHECK(height > 2 * (48 + 9));
  // A script that does not compile is said, and leaves its place empty.
  const Outcome run = folder.mms("render a.mms bad.mms" + options + "hole.png");
  CHECK(run.exit == 1);
  CHECK(contains(run.err, "bad.mms"));
  CHECK(size_of(folder.read("hole.png")).first == width);
  CHECK(folder.mms("render bad.mms bad.mms" + options + "none.png").exit == 1);
  CHECK_FALSE(folder.has("none.png"));
}

TEST_CASE("a sweep shows a param at its values, in a row") {
  const Folder folder;
  folder.write("a.mms", "param real shade = 0.3;\nsurface \"a\" bsdf = matte(shade); end\n");
  const std::string options = " --size 32x32 --samples 2 ";
  const Outcome run =
      folder.mms("render a.mms --sweep shade=0:0.8:5 -o s.png --format=json" + options);
  INFO(run.err);
  REQUIRE(run.exit == 0);
  for (const char* caption :
       {"shade = 0\"", "shade = 0.2", "shade = 0.4", "shade = 0.6", "shade = 0.8"})
    CHECK(contains(run.out, caption));
  const auto [width, height] = size_of(folder.read("s.png"));
  CHECK(width == 5 * (32 + 4) + 4);
  CHECK(height < 32 + 40);
  for (const char* bad : {"shade", "shade=0:1", "shade=0:1:1", "shade=0:x:3", "=0:1:3", "a:b=1"}) {
    CAPTURE(bad);
    const Outcome wrong = folder.mms("render a.mms --sweep " + std::string(bad) + options);
    CHECK(wrong.exit == 2);
    CHECK(contains(wrong.err, "--sweep"));
  }
  const Outcome none = folder.mms("render a.mms --sweep shape=0:1:7 -o n.png" + options);
  CHECK(none.exit == 2);
  CHECK(none.err ==
        "error: --sweep: a.mms has no param `shape`\n  = help: did you mean `shade`?\n");
  // A value that does not fit is told before any picture of the others is made.
  folder.write("b.mms",
               "param integer steps = 3 in [0, 9];\n"
               "surface \"b\" bsdf = matte(0.1 * steps); end\n");
  for (const auto& [sweep, what] : {std::pair("steps=0:2:4", "expected `integer`, found `real`"),
                                    std::pair("steps=8:10:3", "`steps` is 10, outside")}) {
    CAPTURE(sweep);
    const Outcome wrong =
        folder.mms("render b.mms -o b.png --sweep " + std::string(sweep) + options);
    CHECK(wrong.exit == 2);
    CHECK(wrong.out == "");
    CHECK(contains(wrong.err, what));
    CHECK_FALSE(folder.has("b.png"));
  }
  CHECK(folder.mms("render - --sweep shade=0:1:2 -o n.png" + options).exit == 2);
  CHECK(folder.mms("render a.mms --sweep shade=0:1:2 --watch" + options).exit == 2);
}

TEST_CASE("two sweeps are a table: the first across, the second down") {
  const Folder folder;
  folder.write("a.mms",
               "param real shade = 0.3;\nparam real blue = 0;\n"
               "surface \"a\" bsdf = matte(rgb(shade, shade, blue)); end\n");
  const std::string options = " --size 32x32 --samples 2 ",
                    both = "render a.mms --sweep shade=0:0.8:3 --sweep blue=0:1:2 ";
  const Outcome run = folder.mms(both + "-o s.png --format=json" + options);
  INFO(run.err);
  REQUIRE(run.exit == 0);
  std::size_t at = 0;  // row by row
  for (const char* caption :
       {"shade = 0, blue = 0\"", "shade = 0.4, blue = 0\"", "shade = 0.8, blue = 0\"",
        "shade = 0, blue = 1\"", "shade = 0.4, blue = 1\"", "shade = 0.8, blue = 1\""}) {
    CAPTURE(caption);
    at = run.out.find(caption, at);
    CHECK(at != std::string::npos);
  }
  const auto [width, height] = size_of(folder.read("s.png"));
  CHECK(width == 3 * (32 + 4) + 4);
  CHECK(height > 2 * 32);
  const Outcome three = folder.mms(both + "--sweep shade=0:1:3" + options);
  CHECK(three.exit == 2);
  CHECK(contains(three.err, "more than two"));
  CHECK(contains(folder.mms("render a.mms --sweep shade=0:1:3 --sweep shade=0:1:3" + options).err,
                 "`shade` is swept twice"));
  CHECK(contains(folder.mms("render a.mms --sweep shade=0:1:30 --sweep blue=0:1:30" + options).err,
                 "900 pictures"));
  CHECK(contains(folder.mms("render a.mms --sweep shade=0:1:3 --sweep red=0:1:3" + options).err,
                 "no param `red`"));
}

TEST_CASE("what there is to say of a script is said once, however many pictures show it") {
  const Folder folder;
  // The second warning is of one value only, the third of several, each with another number.
  folder.write("s.mms",
               "param real shade = 0.3;\nparam real other = 1;\n"
               "surface \"a\" bsdf = matte(0.5 / (shade - 1)); end\n"
               "surface \"b\" bsdf = matte(2 + shade); end\n");
  const std::string options = " --size 8x8 --samples 1 ";
  const auto times = [](const Outcome& run, const std::string& part) {
    int count = 0;
    for (std::size_t at = run.err.find(part); at != std::string::npos;
         at = run.err.find(part, at + 1))
      ++count;
    return count;
  };
  const Outcome sweep = folder.mms("render s.mms --sweep shade=0:1:3 -o s.png" + options);
  INFO(sweep.err);
  CHECK(sweep.exit == 0);
  CHECK(times(sweep, "param `other` is never used") == 1);
  CHECK(times(sweep, "division by zero") == 1);
  CHECK(times(sweep, "weights of this material add up to 2 ") == 1);
  CHECK(times(sweep, "weights of this material") == 2);  // of `a` too, where it is infinite
  CHECK(times(sweep, "rendering `a`") == 1);
  for (const char* args :
       {"s.mms s.mms -o t.png", "s.mms --turntable 3 -o t.png", "- --turntable 3 -o t.png"}) {
    CAPTURE(args);
    const Outcome run = folder.mms("render " + std::string(args) + options, folder.read("s.mms"));
    INFO(run.err);
    CHECK(run.exit == 0);
    CHECK(times(run, "is never used") == 1);
    CHECK(times(run, "weights of this material") == 1);
    CHECK(times(run, "rendering `a`") == 1);
  }
  const Outcome json =
      folder.mms("render s.mms --sweep shade=0:1:3 -o s.png --format=json" + options);
  CHECK(times({0, "", json.out}, "W0404") == 1);
}

TEST_CASE("each compiled program that lacks an image is told, once on each sheet") {
  const Folder folder;
  folder.write("p.pgm", "P2 1 1 255 128\n");
  folder.write("s.mms", "surface \"s\" bsdf = matte(image(\"p.pgm\", $uv)); end\n");
  for (const char* program : {"a.mmsc", "b.mmsc"})
    REQUIRE(folder.mms("compile s.mms -o " + std::string(program)).exit == 0);
  REQUIRE(folder.bash("rm p.pgm").exit == 0);
  const Outcome run = folder.mms(
      "render a.mmsc b.mmsc a.mmsc --missing=magenta --size 8x8 --samples 1 -o sheet.png");
  INFO(run.err);
  CHECK(run.exit == 0);
  for (const std::string program : {"`a.mmsc`", "`b.mmsc`"}) {
    const std::size_t first = run.err.find(program);
    CHECK(first != run.err.npos);
    CHECK(run.err.find(program, first + 1) == run.err.npos);
  }
}

TEST_CASE("a sheet that is stopped says how much of it is there, and none goes on from before") {
  const Folder folder;
  folder.write("s.mms", "param real shade = 0.3;\nsurface \"s\" bsdf = matte(shade); end\n");
  // Stopped when the first of many pictures is there.
  const Outcome run = folder.bash(R"BASH(
touch log
mms-render render s.mms --sweep shade=0:1:400 --size 32x32 --samples 16 -o s.png >log 2>err & child=$!
for i in $(seq 3000); do
  grep -q 'shade = 0:' log && break; sleep 0.01
done
kill -INT $child; wait $child; echo "ended $?"; cat err; tail -n 1 log
)BASH");
  INFO(run.out, run.err);
  CHECK(contains(run.out, "ended 130\n"));
  CHECK(contains(run.out, "stopped: s.png has "));
  CHECK(contains(run.out, " of 400 pictures in full"));
  CHECK_FALSE(contains(run.out, "has 400"));
  CHECK_FALSE(contains(run.out, "s.png: 400 pictures"));
  CHECK(folder.has("s.png"));
  folder.write("a.mms", "surface \"a\" bsdf = matte(0.1); end\n");
  for (const char* args : {"a.mms a.mms -o t.png --resume", "a.mms a.mms -o t.png --checkpoint 10",
                           "a.mms --watch -o t.png --resume"}) {
    CAPTURE(args);
    const Outcome refused = folder.mms("render --samples 1 --size 8x8 " + std::string(args));
    CHECK(refused.exit == 2);
    CHECK(contains(refused.err, "nothing to go on from"));
  }
  CHECK_FALSE(folder.has("t.png"));
}

TEST_CASE("a folder with a slash is made, and holds a picture of each script or none") {
  const Folder folder;
  folder.write("m.mms", "surface \"a\" bsdf = matte(0.1); end\n");
  folder.write("n.mms", "surface \"a\" bsdf = matte(0.2); end\n");
  const std::string options = " --quiet --size 8x8 --samples 1 -o ";
  CHECK(folder.mms("render m.mms n.mms" + options + "out/deep/").exit == 0);
  CHECK(folder.has("out/deep/m.png"));
  CHECK(folder.has("out/deep/n.png"));
  CHECK(folder.mms("render m.mms --turntable 2" + options + "turn/").exit == 0);
  CHECK(folder.has("turn/m.001.png"));
  CHECK(folder.mms("render m.mms --sweep x=0:1:2" + options + "m.mms/").exit == 3);
  CHECK(folder.mms("render m.mms m.mms" + options + "sheets/").exit == 2);
  CHECK_FALSE(folder.has("sheets"));
  folder.write("out/m.mms", folder.read("n.mms"));
  for (const char* output : {"two/", "out", ""}) {
    CAPTURE(output);
    const Outcome run = folder.mms("render m.mms out/m.mms --size 8x8 --samples 1" +
                                   (*output ? std::string(" -o ") + output : std::string()));
    CHECK(run.exit == 2);
    CHECK(contains(run.err, "the pictures of m.mms and out/m.mms would both be"));
  }
  CHECK_FALSE(folder.has("two"));
  CHECK_FALSE(folder.has("out/m.png"));
}

TEST_CASE("a turntable turns the test object, and ends where it began") {
  const Folder folder;
  // One half white, one half black, about the vertical axis.
  folder.write("a.mms",
               "surface \"a\" bsdf = matte(smoothstep(-0.1, 0.1, $object_position[0])); end\n");
  const std::string options = " --quiet --scene furnace --size 32x32 --samples 4 ";
  const Outcome run = folder.mms("render a.mms --turntable 4 -o t.exr" + options);
  INFO(run.err);
  REQUIRE(run.exit == 0);
  CHECK(folder.file_count() == 5);
  REQUIRE(folder.mms("render a.mms -o still.exr" + options).exit == 0);
  CHECK(difference(folder, "t.000.exr still.exr") == 0);
  CHECK(difference(folder, "t.001.exr still.exr") > 0.01);
  // A quarter and three quarters show the halves from the front: one bright, one dark, or mirrored
  // pictures, by where the camera stands; never the same.
  CHECK(difference(folder, "t.001.exr t.003.exr") > 0.01);
}

#endif
