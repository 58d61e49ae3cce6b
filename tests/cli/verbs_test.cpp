// SPDX-License-Identifier: Apache-2.0
// What each verb does when all is well.
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using nlohmann::json;

namespace {

constexpr const char* kMarble =
    "param real scale = 4.0 in [0.1, 20], label = \"Scale\";\n"
    "real stripe(real x) = x - 2 * x;\n"
    "surface \"marble\"\n"
    "  bsdf = mix(matte(0.25), matte(0.75), scale * $position[0]);\n"
    "  height = stripe($uv[1]);\n"
    "end\n";

std::string eval(const std::string& args, const std::string& input = "") {
  const Folder folder;
  const Outcome run = folder.mms("eval " + args, input);
  INFO(run.err);
  CHECK(run.exit == 0);
  CHECK(run.err == "");
  return run.out;
}

}  // namespace

TEST_CASE("help and version") {
  const Folder folder;
  const Outcome version = folder.mms("--version");
  CHECK(version.exit == 0);
  CHECK(version.out.starts_with("mms "));
  const Outcome help = folder.mms("--help");
  CHECK(help.exit == 0);
  for (const char* part :
       {"check", "render", "info", "eval", "bounds", "disasm", "accuracy", "profile", "furnace",
        "fmt", "test", "explain", "doc", "completion", "Exit codes", "Examples", "70", "130"})
    CHECK(contains(help.out, part));
  for (const char* verb : {"check", "render", "info", "eval", "bounds", "disasm", "accuracy",
                           "profile", "furnace", "fmt", "test", "explain", "doc"}) {
    const Outcome run = folder.mms(std::string(verb) + " --help");
    INFO(verb);
    CHECK(run.exit == 0);
    CHECK(contains(run.out, "Examples:\n  mms " + std::string(verb)));
  }
}

TEST_CASE("check says nothing about a good script, from a file or standard input") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  for (const char* args : {"check marble.mms", "check -O0 marble.mms", "check -",
                           "check --set scale=8 marble.mms", "check marble.mms marble.mms"}) {
    const Outcome run = folder.mms(args, kMarble);
    INFO(args, run.err);
    CHECK(run.exit == 0);
    CHECK(run.out == "");
    CHECK(run.err == "");
  }
}

TEST_CASE("check goes on after a bad file, and the worst counts") {
  const Folder folder;
  folder.write("bad.mms", "surface \"s\" bsdf = mate(0.5); end\n");
  folder.write("worse.mms", "surface\n");
  const Outcome run = folder.mms("check bad.mms worse.mms missing.mms");
  CHECK(run.exit == 3);
  CHECK(contains(run.err, "bad.mms:1:"));
  CHECK(contains(run.err, "worse.mms:"));
  CHECK(contains(run.err, "missing.mms"));
}

TEST_CASE("colours are for terminals, or where asked for") {
  const Folder folder;
  folder.write("bad.mms", "surface \"s\" bsdf = mate(0.5); end\n");
  CHECK_FALSE(contains(folder.mms("check bad.mms").err, "\x1b["));
  CHECK_FALSE(contains(folder.mms("check --color=never bad.mms").err, "\x1b["));
  CHECK(contains(folder.mms("check --color=always bad.mms").err, "\x1b["));
}

TEST_CASE("check prints JSON for pipelines") {
  const Folder folder;
  folder.write("bad.mms", "surface \"s\"\n  bsdf = mate(0.5);\nend\n");
  const Outcome run = folder.mms("check --format=json bad.mms");
  CHECK(run.exit == 1);
  std::istringstream lines(run.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const json message = json::parse(line);
    CHECK(message.at("severity") == "error");
    CHECK(message.at("file") == "bad.mms");
    CHECK(message.at("line") == 2);
    CHECK(message.at("column") == 10);
    CHECK(message.at("code").get<std::string>().front() == 'E');
  }
  CHECK(count == 1);
}

TEST_CASE("explain prints the page of a code that a message showed") {
  const Folder folder;
  folder.write("bad.mms", "surface \"s\" bsdf = mate(0.5); end\n");
  const std::string err = folder.mms("check bad.mms").err;
  const std::size_t at = err.find("error[");
  REQUIRE(at != std::string::npos);
  const std::string code = err.substr(at + 6, 5);
  const Outcome run = folder.mms("explain " + code);
  CHECK(run.exit == 0);
  CHECK(run.out.starts_with(code));
}

TEST_CASE("explain of a script prints its messages, and the page of each once") {
  const Folder folder;
  folder.write("bad.mms", "surface \"s\" bsdf = mate(0.5); emission = mate(1); end\n");
  folder.write("good.mms", "surface s bsdf = matte(1); end\n");
  folder.write("unused.mms", "surface s x = 1; bsdf = matte(1); end\n");
  for (const std::string args : {"explain bad.mms", "explain - <bad.mms"}) {
    const Outcome run = folder.bash("mms " + args);
    CHECK(run.exit == 1);
    CHECK(contains(run.err, "mate"));
    const std::string code = run.err.substr(run.err.find("error[") + 6, 5);
    CHECK(run.out == folder.mms("explain " + code).out);
  }
  CHECK(folder.mms("explain good.mms").out.empty());
  CHECK(folder.mms("explain unused.mms").exit == 0);
  CHECK(folder.mms("explain -Wno-unused unused.mms").out.empty());
  const Outcome strict = folder.mms("explain -Werror E0203 unused.mms");
  CHECK(strict.exit == 1);
  CHECK(strict.out.starts_with(folder.mms("explain E0203").out));
  CHECK(folder.mms("explain missing.mms").exit == 3);
}

TEST_CASE("eval prints values of every type") {
  CHECK(eval("'1 + 2'") == "3\n");
  CHECK(eval("'1 / 2'") == "0.5\n");
  CHECK(eval("'2 > 1'") == "true\n");
  CHECK(eval("'1 + 1 // two'") == "2\n");
  CHECK(eval("'2i * 2i + 1i'") == "-4+1i\n");
  CHECK(eval("-- '-7 % 3'") == "2\n");
  CHECK(eval("'[1.0, 2.0, 3.5]'") == "[1, 2, 3.5]\n");
  CHECK(eval("'[sqrt(-1.0), -sqrt(-1.0)]'") == "[nan, nan]\n");
}

TEST_CASE("eval reads variables, files and standard input") {
  CHECK(eval("'$position[1] * 2' --set position=[1,2.5,3]") == "5\n");
  CHECK(eval("'$normal'") == "[0, 0, 1]\n");
  CHECK(eval("'$wavelength' --set wavelength=0.5") ==
        "spectrum(0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5)\n");
  CHECK(eval("-f - 'sq(7.0)'", "real sq(real x) = x * x;\n") == "49\n");
  CHECK(eval("-", "const real half = 0.5;\n") == "half = 0.5\n");
  CHECK(eval("--set k=3 -f - 'k * 2'", "param integer k = 1;\n") == "6\n");
}

TEST_CASE("eval in double does not pass through float") {
  // 1/3 rounded to 53 bits, not to 24.
  CHECK(eval("'1.0 / 3.0' --precision=double") == "0.3333333333333333\n");
  CHECK(eval("'1.0 / 3.0'") == "0.33333334\n");
}

TEST_CASE("info tells what a descriptor knows of itself") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const Outcome run = folder.mms("info --format=json marble.mms");
  INFO(run.err);
  REQUIRE(run.exit == 0);
  const json info = json::parse(run.out);
  CHECK(info.at("params").at(0).at("name") == "scale");
  CHECK(info.at("params").at(0).at("range") == json({0.1, 20.0}));
  const json& marble = info.at("descriptors").at(0);
  CHECK(marble.at("form") == "surface");
  CHECK(marble.at("name") == "marble");
  CHECK(marble.at("line") == 3);
  const json& bsdf = marble.at("outputs").at("bsdf");
  CHECK(bsdf.at("stated") == true);
  CHECK(bsdf.at("rate") == "varying");
  CHECK(bsdf.at("reciprocal") == true);
  CHECK(bsdf.at("lobes").at(2) == json({{"name", "mix"}, {"traits", {"combiner"}}}));
  CHECK(bsdf.at("reads") == json({"$position"}));
  CHECK(bsdf.at("material") == "mix(matte, matte)");
  CHECK(marble.at("outputs").at("height").at("reads") == json({"$uv"}));
  CHECK(marble.at("outputs").at("emission").at("rate") == "constant");
  const json& displace = marble.at("entries").at("displace");
  CHECK(displace.at("instructions") > 3);
  CHECK(displace.at("recursion") == "none");
  CHECK(displace.at("back_edges") == 0);
  CHECK(marble.at("entries").at("emit").at("instructions") == 0);
  CHECK(marble.at("outputs").at("emission").at("stated") == false);
  const Outcome text = folder.mms("info marble.mms");
  CHECK(text.exit == 0);
  CHECK(contains(text.out, "surface marble  (marble.mms:3)\n"));
}

TEST_CASE("info tells uniform outputs, reciprocity and recursion") {
  const Folder folder;
  const Outcome run = folder.mms(
      "info --format=json -",
      "real fade(real x, integer n) = select x, if n <= 0; fade(x / 2, n - 1) otherwise end;\n"
      "surface s\n  bsdf = matte(abs($view.z));\n  emission = $time;\n"
      "  height = fade($uv.x, integer($uv.y));\n  gradient = [0, 0];\nend\n");
  INFO(run.err);
  REQUIRE(run.exit == 0);
  const json info = json::parse(run.out);
  CHECK(info.at("schema") == 1);
  const json& s = info.at("descriptors").at(0);
  CHECK(s.at("reciprocal") == false);
  CHECK(s.at("outputs").at("bsdf").at("reciprocal") == false);
  CHECK(s.at("outputs").at("emission").at("rate") == "uniform");
  CHECK(s.at("entries").at("displace").at("recursion") == "tail");
  CHECK(s.at("entries").at("displace").at("back_edges") == 1 << 20);
}

TEST_CASE("info and the page about it name the same members") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const json info = json::parse(folder.mms("info --format=json marble.mms").out);
  const std::string page = folder.mms("doc info").out;
  const json& d = info.at("descriptors").at(0);
  for (const json* object : {&info, &d, &d.at("outputs").at("bsdf"), &d.at("entries").at("shade"),
                             &info.at("params").at(0)})
    for (const auto& [name, unused] : object->items()) {
      INFO(name);
      CHECK(contains(page, "`" + name + "`"));
    }
}

TEST_CASE("disasm --dump-after prints the graph after a pass that runs") {
  const Folder folder;
  folder.write("s.mms", "const real a = 1 + 2;\nsurface s bsdf = matte($uv.x + 0.5); end\n");
  const Outcome first = folder.mms("disasm -O1 --dump-after=fold s.mms");
  const Outcome last = folder.mms("disasm -O1 --dump-after=dead-again s.mms");
  INFO(first.err);
  CHECK(first.exit == 0);
  CHECK(contains(first.out, "PushInput"));
  CHECK(contains(last.out, "PushInput"));
  CHECK(last.out.size() < first.out.size());  // what folding leaves behind is dropped
  const Outcome none = folder.mms("disasm -O0 --dump-after=fold s.mms");
  CHECK(none.exit == 2);
  CHECK(contains(none.err, "does not run at -O0"));
  CHECK(folder.mms("disasm --dump-after=flod s.mms").exit == 2);
  REQUIRE(folder.mms("compile s.mms -o s.mmsc").exit == 0);
  const Outcome stored = folder.mms("disasm --dump-after=fold s.mmsc");
  CHECK(stored.exit == 2);
  CHECK(contains(stored.err, "a compiled program has its passes behind it"));
  CHECK(contains(folder.mms("doc passes").out, "| `fold` | -O1 |"));
}

TEST_CASE("--deps lists what is imported: lines, a rule for make, or JSON") {
  const Folder folder;
  folder.write("a part.mms", "import \"deep.mms\";\nreal half() = deep / 2;\n");
  folder.write("deep.mms", "real deep() = 1;\n");
  folder.write("s.mms",
               "import \"a part.mms\";\nimport \"noise\" as n;\n"
               "surface s bsdf = matte(half * n::turbulence($position, 2)); end\n");
  for (const std::string verb : {"check", "info"}) {
    CHECK(folder.mms(verb + " --deps s.mms").out == "a part.mms\ndeep.mms\n");
    CHECK(folder.mms(verb + " --deps=make s.mms").out == "s.png: s.mms a\\ part.mms deep.mms\n");
    CHECK(json::parse(folder.mms(verb + " --deps --format=json s.mms").out) ==
          json({{"file", "s.mms"}, {"dependencies", {"a part.mms", "deep.mms"}}}));
  }
  CHECK(folder.mms("check --deps=html s.mms").exit == 2);
}

TEST_CASE("disasm prints the bytecode") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const Outcome run = folder.mms("disasm marble.mms");
  CHECK(run.exit == 0);
  CHECK(contains(run.out, "PushInput"));
  CHECK(contains(run.out, "Return"));
}

TEST_CASE("doc lists, prints, writes and checks its pages") {
  const Folder folder;
  CHECK(contains(folder.mms("doc").out, "bytecode"));
  CHECK(contains(folder.mms("doc inputs").out, "`$position`"));
  CHECK(contains(folder.mms("doc stdlib").out, "material matte("));
  CHECK(contains(folder.mms("doc bytecode").out, "| `AddR` |"));
  CHECK(folder.mms("doc --check .").exit == 3);
  CHECK(folder.mms("doc --write .").exit == 0);
  CHECK(folder.mms("doc --check .").exit == 0);
  folder.write("inputs.md", "stale");
  CHECK(folder.mms("doc --check .").exit == 1);
}

#if MMS_RENDERER

TEST_CASE("render writes a picture and one line about it") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const Outcome run = folder.mms("render marble.mms --size 16x8 --samples 2");
  INFO(run.err);
  CHECK(run.exit == 0);
  CHECK(run.err == "");
  CHECK(run.out.starts_with("marble.png: 2 samples per pixel, "));
  CHECK(folder.mms("render marble.mms --size 16x8 --samples 1 -o one.png")
            .out.starts_with("one.png: 1 sample per pixel, "));
  CHECK(contains(run.out, "estimated error"));
  const std::string png = folder.read("marble.png");
  REQUIRE(png.size() > 24);
  CHECK(png.substr(1, 3) == "PNG");
  CHECK(png[19] == 16);  // width and height, big-endian, of the IHDR chunk
  CHECK(png[23] == 8);
  CHECK(folder.file_count() == 3);
}

TEST_CASE("render of several scripts, to a folder, as JSON") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  folder.write("plain.mms", "surface \"other\" bsdf = matte(0.5); end\n");
  const Outcome run =
      folder.mms("render marble.mms plain.mms -o . --size 8x8 --samples 2 --format=json");
  INFO(run.err);
  REQUIRE(run.exit == 0);
  std::istringstream lines(run.out);
  for (const char* name : {"marble", "plain"}) {
    std::string line;
    REQUIRE(std::getline(lines, line));
    const json report = json::parse(line);
    CHECK(report.at("script") == std::string(name) + ".mms");
    CHECK(report.at("samples") == 2);
    CHECK(folder.has(std::string(name) + ".png"));
  }
}

TEST_CASE("bounds encloses stated outputs over a box, as text and as JSON") {
  const Folder folder;
  folder.write("hill.mms",
               "surface hill\n  bsdf = matte(0.5);\n"
               "  height = $position[0] * $position[0] + 1;\nend\n");
  Outcome run = folder.mms("bounds hill.mms");
  CHECK(run.exit == 0);
  CHECK(run.err == "");
  CHECK(contains(run.out, "surface hill\n  height      [1, 2]\n"));
  run = folder.mms("bounds --over '$position=[2,3],0,0' --output height --format=json hill.mms");
  CHECK(run.exit == 0);
  const json height = json::parse(run.out)[0]["outputs"]["height"];
  CHECK(height["lo"][0] == 5.0);
  CHECK(height["hi"][0] == 10.0);
  CHECK(height["nan"] == false);
  // The last argument's mistake is told with what to try.
  for (const char* bad : {"--over position=[1,0],0,0", "--over positoin=0", "--over position=[0,1",
                          "--grid 0", "--grid 1x"}) {
    run = folder.mms(std::string("bounds hill.mms ") + bad);
    INFO(bad);
    CHECK(run.exit == 2);
    CHECK(contains(run.err, "= help:"));
  }
  run = folder.mms("bounds --output heigth hill.mms");
  CHECK(run.exit != 0);
  CHECK(contains(run.err, "try height"));
  // What a material weighs at most is told by info.
  run = folder.mms("info hill.mms");
  CHECK(contains(run.out, "proven: weights never exceed one (at most 0.5)"));
}

TEST_CASE("a script from standard input renders to EXR") {
  const Folder folder;
  const Outcome run = folder.mms("render - -o a.exr --size 8x8 --samples 2 --quiet", kMarble);
  INFO(run.err);
  CHECK(run.exit == 0);
  CHECK(run.out == "");
  CHECK(folder.read("a.exr").substr(0, 4) == "\x76\x2f\x31\x01");
}

TEST_CASE("which surface: the one named like the file, else the first, with a note") {
  const Folder folder;
  const std::string two =
      "surface \"a\" bsdf = matte(0); end\nsurface \"b\" bsdf = matte(1); end\n";
  folder.write("b.mms", two);
  folder.write("c.mms", two);
  const std::string small = " --size 8x8 --samples 2 --threads 1 -o ";
  CHECK(folder.mms("render b.mms" + small + "named.png").err == "");
  CHECK(contains(folder.mms("render c.mms" + small + "first.png").err, "rendering `a`"));
  CHECK(folder.mms("render c.mms --surface b" + small + "asked.png").err == "");
  CHECK(folder.read("named.png") == folder.read("asked.png"));
  CHECK(folder.read("named.png") != folder.read("first.png"));
}

TEST_CASE("the report counts") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const Outcome run = folder.mms("render marble.mms --size 8x8 --samples 2 --report");
  CHECK(run.exit == 0);
  for (const char* counter : {"script_runs", "script_points", "batch_fill", "media_steps"})
    CHECK(contains(run.out, counter));
}

TEST_CASE("Ctrl-C writes what is there") {
  const Folder folder;
  const Outcome run =
      folder.interrupted_render("-o cut.png --size 64x64 --samples 1000000", kMarble);
  INFO(run.err);
  CHECK(run.exit == 130);
  CHECK(contains(run.err, "stopped: cut.png"));
  CHECK(folder.read("cut.png").substr(1, 3) == "PNG");
  CHECK(folder.has("cut.png.film"));
  CHECK(folder.file_count() == 2);
}

#else

TEST_CASE("render says that it is not built") {
  const Folder folder;
  folder.write("marble.mms", kMarble);
  const Outcome run = folder.mms("render marble.mms");
  CHECK(run.exit == 2);
  CHECK(contains(run.err, "without the renderer"));
  CHECK(contains(run.err, "help: "));
  CHECK(folder.file_count() == 1);
}

#endif
