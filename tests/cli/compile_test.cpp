// SPDX-License-Identifier: Apache-2.0
// mms compile, and compiled programs in place of scripts.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kScript =
    "/// How many.\n"
    "param real scale = 4.0 in [0.1, 20], label = \"Scale\";\n"
    "import \"parts.mms\";\n"
    "const half = part / 2;\n"
    "real noise() = perlin(scale * $position);\n"
    "surface \"marble\"\n"
    "  bsdf = mix(matte(0.25), glossy(0.75, 40.0), noise());\n"
    "  height = 0.01 * sin($uv[1]);\n"
    "end\n";

/// A folder with wood.mms and the wood.mmsc it is compiled to.
struct Compiled {
  Compiled() {
    folder.write("wood.mms", kScript);
    folder.write("parts.mms", "const part = 3.0;\n");
    const Outcome run = folder.mms("compile wood.mms -o wood.mmsc");
    INFO(run.err);
    REQUIRE(run.exit == 0);
    REQUIRE(run.out == "");
    REQUIRE(run.err == "");
  }
  Folder folder;
};

}  // namespace

TEST_CASE("every verb says the same of a compiled program as of its script") {
  const Compiled c;
  for (const std::string verb :
       {"check", "info", "info --format=json", "disasm", "eval --set position=[1.5,0.25,2]"}) {
    CAPTURE(verb);
    const Outcome script = c.folder.mms(verb + " wood.mms");
    const Outcome program = c.folder.mms(verb + " wood.mmsc");
    CHECK(program.exit == 0);
    CHECK(program.out == script.out);
    CHECK(program.err == "");
  }
  CHECK(contains(c.folder.mms("info --format=json wood.mmsc").out, "parts.mms"));
}

TEST_CASE("a compiled program stands alone: its scripts may go") {
  const Compiled c;
  c.folder.write("wood.mms", "nothing that could be read");
  c.folder.write("parts.mms", "nor this");
  CHECK(contains(c.folder.mms("eval wood.mmsc").out, "half = 1.5\n"));
}

TEST_CASE("compiling a compiled program copies it, and it may come from standard input") {
  const Compiled c;
  REQUIRE(c.folder.mms("compile wood.mmsc -o again.mmsc").exit == 0);
  CHECK(c.folder.read("again.mmsc") == c.folder.read("wood.mmsc"));
  CHECK(c.folder.mms("info -", c.folder.read("wood.mmsc")).out ==
        c.folder.mms("info wood.mmsc").out);
}

TEST_CASE("params are fixed when a program is compiled") {
  const Compiled c;
  REQUIRE(c.folder.mms("compile --set scale=2 wood.mms -o two.mmsc").exit == 0);
  CHECK(contains(c.folder.mms("info two.mmsc").out, "param real scale = 2"));
  const Outcome run = c.folder.mms("info --set scale=3 wood.mmsc");
  CHECK(run.exit == 2);
  CHECK(run.err ==
        "error: wood.mmsc: is a compiled program: its param `scale` has a value\n"
        "  = help: give the value to `mms compile`\n");
}

TEST_CASE("a compiled program is linked with nothing more") {
  const Compiled c;
  for (const std::string args : {"info wood.mmsc parts.mms", "eval -f wood.mmsc half"}) {
    const Outcome run = c.folder.mms(args);
    CHECK(run.exit == 2);
    CHECK(contains(run.err, "wood.mmsc: is a compiled program, which cannot be linked"));
  }
}

TEST_CASE("a damaged program is refused by every verb, with the byte and a help") {
  const Compiled c;
  std::string bytes = c.folder.read("wood.mmsc");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  c.folder.write("bad.mmsc", bytes);
  c.folder.write("cut.mmsc", bytes.substr(0, 100));
  c.folder.write("text.mmsc", kScript);
  const auto says = [&](const std::string& args, const std::string& text) {
    const Outcome run = c.folder.mms(args);
    CAPTURE(args);
    CHECK(run.exit == 3);
    CHECK(run.out == "");
    CHECK(contains(run.err, text));
    CHECK(contains(run.err, "  = help: "));
  };
  for (const std::string verb : {"check ", "info ", "disasm ", "eval ", "compile -o x.mmsc "}) {
    says(verb + "bad.mmsc", "error: bad.mmsc: byte 12: is damaged");
    says(verb + "cut.mmsc", "error: cut.mmsc: byte 16: is 100 bytes long");
    says(verb + "text.mmsc", "error: text.mmsc: byte 0: is no compiled program");
  }
  CHECK(!c.folder.has("x.mmsc"));
#if MMS_RENDERER
  says("render bad.mmsc -o bad.png", "error: bad.mmsc: byte 12: is damaged");
  CHECK(!c.folder.has("bad.png"));
#endif
}

#if MMS_RENDERER
TEST_CASE("a compiled program renders the same picture") {
  const Compiled c;
  const std::string small = " --size 16x16 --samples 2 --quiet -o ";
  REQUIRE(c.folder.mms("render wood.mms" + small + "a.png").exit == 0);
  REQUIRE(c.folder.mms("render wood.mmsc" + small + "b.png").exit == 0);
  CHECK(c.folder.read("a.png") == c.folder.read("b.png"));
}
#endif

TEST_CASE("a file that cannot be written leaves nothing behind, and a bad script writes none") {
  const Compiled c;
  const int files = c.folder.file_count();
  CHECK(c.folder.mms("compile wood.mms -o no/such.mmsc").exit == 3);
  c.folder.write("parts.mms", "const part = ;\n");
  CHECK(c.folder.mms("compile wood.mms -o wood.mmsc").exit == 1);
  CHECK(c.folder.mms("compile wood.mms").exit == 2);
  CHECK(c.folder.file_count() == files);
  CHECK(contains(c.folder.mms("eval wood.mmsc").out, "half = 1.5\n"));
}
