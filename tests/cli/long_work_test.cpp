// SPDX-License-Identifier: Apache-2.0
// Renders that take long: split, stopped, killed, out of disk. Nothing is lost and nothing differs.
#include <csignal>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/setting.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kScript = "surface \"s\" bsdf = matte(0.5 + 0.4 * $position[1]); end\n";

#if MMS_RENDERER
/// Runs well and silently.
void good(const Folder& folder, const std::string& args) {
  const Outcome run = folder.mms(args);
  INFO(args, ": ", run.err);
  REQUIRE(run.exit == 0);
}

/// Samples of each pixel that a film has.
int samples_of(const Folder& folder, const std::string& film) {
  const Outcome run = folder.mms("merge " + film + " -o samples.png --format=json");
  INFO(run.err);
  REQUIRE(run.exit == 0);
  return nlohmann::json::parse(run.out)["samples"].get<int>();
}

/// Samples that the progress of a render on a terminal showed, one after the other: `K.film:  12%
/// 48 samples, ...`. The last one is left out where it was cut off.
std::vector<int> samples_shown(const std::string& terminal) {
  std::vector<int> all;
  const std::regex line("% ([0-9]+) samples");
  for (std::sregex_iterator it(terminal.begin(), terminal.end(), line), end; it != end; ++it)
    all.push_back(std::stoi((*it)[1]));
  return all;
}
#endif

}  // namespace

#if MMS_RENDERER

TEST_CASE("parts of a picture add up to its very bytes: any split, order, filter and threads") {
  for (const char* filter : {"box", "blackman-harris"}) {
    CAPTURE(filter);
    const Folder folder;
    folder.write("s.mms", kScript);
    const std::string render =
        std::string("render s.mms --quiet --size 40x24 --filter ") + filter + " ";
    good(folder, render + "--samples 24 -o whole.film --threads 2");
    good(folder, render + "--samples 0:3 -o a.film --threads 1");
    good(folder, render + "--samples 3:13 -o b.film --threads 3");
    good(folder, render + "--samples 13:24 -o c.film");
    good(folder, "merge c.film a.film b.film -o sum.film");
    CHECK(folder.read("sum.film") == folder.read("whole.film"));
    // In two steps, and going on from a part.
    good(folder, "merge a.film c.film -o ac.film");
    good(folder, "merge b.film ac.film -o sum.film");
    CHECK(folder.read("sum.film") == folder.read("whole.film"));
    good(folder, render + "--samples 24 -o ac.film --resume");
    CHECK(folder.read("ac.film") == folder.read("whole.film"));
    // The picture of the sum is the picture of the whole.
    good(folder, render + "--samples 24 -o whole.png");
    good(folder, "merge sum.film -o sum.png");
    CHECK(folder.read("sum.png") == folder.read("whole.png"));
    CHECK(folder.read("a.film") != folder.read("whole.film"));
    // What the camera sees first is in films too: 16 samples of it, which only c.film has.
    good(folder, "merge sum.film -o sum.exr");
    CHECK(contains(folder.read("sum.exr"), "albedo.R"));
  }
}

TEST_CASE("a render does not go on where a table that the script reads has changed") {
  const Folder folder;
  folder.write("s.mms", "surface s bsdf = matte(measured(\"t.csv\", $wavelength)); end\n");
  folder.write("t.csv", "400 0.5\n700 0.5\n");
  const std::string render = "render s.mms --quiet --size 16x16 --samples ";
  good(folder, render + "0:4 -o a.film");
  good(folder, render + "4:8 -o b.film");
  good(folder, "merge a.film b.film -o sum.film");
  folder.write("t.csv", "400 0.5\n700 0.6\n");
  good(folder, render + "4:8 -o b.film");
  const Outcome merge = folder.mms("merge a.film b.film -o other.film");
  CHECK(merge.exit == 3);
  CHECK(contains(merge.err, "other scripts"));
  const Outcome resumed = folder.mms(render + "16 -o sum.film --resume");
  CHECK(resumed.exit == 3);
  CHECK(contains(resumed.err, "is of another picture"));
}

TEST_CASE("what does not add up is refused, and says why") {
  const Folder folder;
  folder.write("s.mms", kScript);
  folder.write("t.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  const std::string options = " --quiet --size 16x16 ";
  good(folder, "render s.mms" + options + "--samples 0:4 -o a.film");
  good(folder, "render s.mms" + options + "--samples 3:5 -o overlap.film");
  good(folder, "render s.mms" + options + "--samples 4:8 -o seed.film --seed 1");
  good(folder, "render s.mms" + options + "--samples 4:8 -o filter.film --filter box");
  good(folder, "render t.mms" + options + "--samples 4:8 -o script.film");
  good(folder, "render s.mms" + options + "--samples 4:8 -o scene.film --scene furnace");
  good(folder, "render s.mms" + options + "--samples 4:8 -o sky.film --environment clear");
  good(folder, "render s.mms --quiet --size 16x17 --samples 4:8 -o size.film");
  const std::string film = folder.read("a.film");
  folder.write("cut.film", film.substr(0, film.size() - 1));
  std::string changed = film;
  changed[film.size() / 2] = char(changed[film.size() / 2] ^ 4);
  folder.write("changed.film", changed);
  folder.write("text.film", "surface");
  const struct {
    const char *name, *what;
  } cases[] = {{"overlap", "samples that are in"},
               {"seed", "seed 0 and 1"},
               {"filter", "filter"},
               {"script", "other scripts"},
               {"scene", "other scenes"},
               {"sky", "other scenes"},
               {"size", "size 16x16 and 16x17"},
               {"cut", "is damaged"},
               {"changed", "is damaged"},
               {"text", "is no film"},
               {"none", "cannot be read"}};
  for (const auto& c : cases) {
    CAPTURE(c.name);
    const Outcome run = folder.mms("merge a.film " + std::string(c.name) + ".film -o sum.png");
    CHECK(run.exit == 3);
    CHECK(contains(run.err, std::string(c.name) + ".film"));
    CHECK(contains(run.err, c.what));
    CHECK_FALSE(folder.has("sum.png"));
  }
  // Nor does a render go on from another picture.
  folder.write("p.png.film", folder.read("seed.film"));
  const Outcome run = folder.mms("render s.mms" + options + "--samples 8 -o p.png --resume");
  CHECK(run.exit == 3);
  CHECK(contains(run.err, "is of another picture: seed 1 and 0"));
  CHECK(folder.read("p.png.film") == folder.read("seed.film"));
}

TEST_CASE("Ctrl-C keeps what is there, and --resume goes on to the same bits") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const std::string options = "-o cut.png --size 32x32 --seed 5 --quiet ";
  const Outcome cut = folder.interrupted_render(options + "--samples 100000", kScript);
  CHECK(cut.exit == 130);
  CHECK(contains(cut.err, "--resume goes on"));
  REQUIRE(folder.has("cut.png"));
  REQUIRE(folder.has("cut.png.film"));
  // A few samples more than it had when it was stopped.
  const int samples = samples_of(folder, "cut.png.film") + 8;
  CHECK(samples < 100000);
  good(folder, "render s.mms --resume " + options + "--samples " + std::to_string(samples));
  CHECK_FALSE(folder.has("cut.png.film"));
  good(folder, "render s.mms --size 32x32 --seed 5 --quiet -o whole.png --samples " +
                   std::to_string(samples));
  CHECK(folder.read("cut.png") == folder.read("whole.png"));
}

TEST_CASE("a checkpoint that cannot be written is warned of in a line of its own") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const Outcome run = folder.bash(
      "mkdir a.png.film; mms render s.mms --size 96x96 --samples 512 --checkpoint 0.001 -o a.png");
  CHECK(run.exit == 0);
  CHECK(run.err.starts_with("warning: a.png.film: "));
}

TEST_CASE("a checkpoint that cannot be written when a render was stopped is told as that") {
  const Folder folder;
  REQUIRE(folder.bash("mkdir a.png.film").exit == 0);
  const Outcome run =
      folder.interrupted_render("-o a.png --size 32x32 --checkpoint 0 --samples 100000", kScript);
  CHECK(run.exit == 130);
  CHECK(run.err.starts_with("warning: a.png.film: "));
  CHECK(contains(run.err, "; --resume will lack the last samples\n"));
  CHECK(contains(run.err, "stopped: a.png holds what was there"));
  CHECK_FALSE(contains(run.err, "goes on"));
}

TEST_CASE("a film with more samples than are asked for is not taken for a picture of them") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const std::string render = "render s.mms --quiet --size 24x24 -o a.film ";
  good(folder, render + "--samples 24");
  const std::string film = folder.read("a.film");
  const Outcome run = folder.mms(render + "--samples 16 --resume");
  CHECK(run.exit == 3);
  CHECK(contains(run.err, "a.film: has samples up to 24 already, more than --samples 16"));
  CHECK(contains(run.err, "mms merge a.film"));
  CHECK(folder.read("a.film") == film);
  good(folder, render + "--samples 24 --resume");
  CHECK(folder.read("a.film") == film);
  // What is there is good enough already, and stays.
  good(folder, render + "--error 1 --resume");
  CHECK(folder.read("a.film") == film);
}

TEST_CASE(
    "a render killed at any moment loses a checkpoint's work at most, and ends with the same "
    "bits") {
  const Folder folder;
  folder.write("s.mms", kScript);
  // One square that threads work on, so that all its pixels have the samples that are shown.
  const std::string render = "render s.mms --size 16x16 --threads 2 --samples ";
  std::mt19937 random(7);
  int before = 0;
  for (int i = 0, kills = int(mms::setting("MMS_KILLS", 3)); i < kills; ++i) {
    CAPTURE(i);
    // Progress is shown ten times a second, each time with a checkpoint behind it.
    const Outcome run =
        folder.killed_on_terminal(render + "10000000 --resume --checkpoint 0.01 -o k.film",
                                  int(random() % 6), int(random() % 100000));
    const std::vector<int> shown = samples_shown(run.out);
    CAPTURE(run.out);
    REQUIRE(run.exit == 128 + SIGKILL);
    const int there = folder.has("k.film") ? samples_of(folder, "k.film") : 0;
    // What was shown last may not be in a checkpoint yet; what was shown before that is.
    if (shown.size() > 1) CHECK(there >= shown[shown.size() - 2]);
    CHECK(there >= before);
    before = there;
  }
  const std::string samples = std::to_string(before + 64);  // with all that threads were ahead
  good(folder, render + samples + " --quiet --resume -o k.film");
  good(folder, render + samples + " --quiet -o whole.film");
  CHECK(folder.read("k.film") == folder.read("whole.film"));
}

TEST_CASE("a full disk leaves the previous picture as it was") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const std::string render = "render s.mms --quiet --size 64x64 --samples 2 ";
  for (const char* name : {"a.png", "a.exr", "a.film"}) {
    CAPTURE(name);
    good(folder, render + "-o " + name);
    const std::string before = folder.read(name);
    const int files = folder.file_count();
    // No file may grow beyond 1 KiB; writing more is an error like that of a full disk.
    const Outcome run = folder.bash("trap '' XFSZ; ulimit -f 1; mms " + render + "--seed 3 -o " +
                                    name + " 2>&1 | cat; exit ${PIPESTATUS[0]}");
    INFO(run.out, run.err);
    CHECK(run.exit == 3);
    CHECK(contains(run.out, "cannot be written"));
    CHECK(folder.read(name) == before);
    CHECK(folder.file_count() == files);
  }
}

#else

TEST_CASE("merge says that it is not built") {
  const Folder folder;
  const Outcome run = folder.mms("merge a.film -o a.png");
  CHECK(run.exit == 2);
  CHECK(contains(run.err, "without the renderer"));
}

#endif
