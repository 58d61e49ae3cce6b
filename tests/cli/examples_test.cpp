// SPDX-License-Identifier: Apache-2.0
// mms test: the examples in doc comments, of scripts and of the library.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/source_dir.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

Outcome test(const std::string& script, const std::string& args = "") {
  const Folder folder;
  folder.write("s.mms", script);
  return folder.mms("test " + args + " s.mms");
}

/// A script whose one example is `expression`, with that value.
Outcome example(const std::string& expression, const std::string& value) {
  return test("/// A number.\n/// >>> " + expression + "\n/// " + value + "\nreal half() = 0.5;\n");
}

void check_passes(const std::string& expression, const std::string& value) {
  const Outcome run = example(expression, value);
  INFO(expression, " = ", value, ": ", run.err);
  CHECK(run.exit == 0);
  CHECK(run.out == "s.mms: 1 example, 0 failed\n");
  CHECK(run.err == "");
}

void check_fails(const std::string& expression, const std::string& value,
                 const std::string& found) {
  const Outcome run = example(expression, value);
  INFO(expression, " = ", value, ": ", run.err);
  CHECK(run.exit == 1);
  CHECK(run.out == "s.mms: 1 example, 1 failed\n");
  CHECK(contains(run.err, "s.mms:2: `" + expression + "` is not what the comment says"));
  CHECK(contains(run.err, "\n  expected: " + value + "\n"));
  CHECK(contains(run.err, "\n  found:    " + found));
}

}  // namespace

TEST_CASE("examples that hold") {
  check_passes("half", "0.5");
  check_passes("half", "1 / 2");
  check_passes("half + 1e-7", "0.5");  // within a millionth
  check_passes("2 + 3", "5");
  check_passes("half < 1", "true");
  check_passes("[half, 1, 2]", "[0.5, 1, 2]");
  check_passes("(1 + 2i) * 1i", "-2 + 1i");
  check_passes("rgb(0.25, 0.25, 0.25)", "0.25");
  check_passes("550nm", "5.5e-7");
  check_passes("sqrt(-1.0)", "0.0 / 0.0");
  check_passes("1.0 / 0.0", "1.0 / 0");
  check_passes("sqrt(2.0)", "1.41...");
  check_passes("[sqrt(2.0), 1]", "[1.41..., 1]");
  check_passes("sqrt(2.0) * 1e-9", "1.41...e-9");
  check_passes("bk7()", "1.5...");
}

TEST_CASE("examples that do not") {
  check_fails("half", "0.6", "0.5");
  check_fails("half + 1e-6", "0.5", "0.500001");
  check_fails("2 + 3", "6", "5");
  check_fails("550nm", "5.6e-7", "5.5e-07");
  check_fails("sqrt(2.0)", "1.43...", "1.4142135");
  check_fails("[half, 1]", "[0.5, 2]", "[0.5, 1]");
  check_fails("[half, 1]", "[0.5, 1, 2]", "[0.5, 1]");
  check_fails("[sqrt(2.0), 1]", "[1.41..., 1.1]", "[1.4142135, 1]");
  check_fails("half", "true", "0.5");
  check_fails("half", "nonsense(", "0.5");
  check_fails("hafl", "0.5", "error[E0201]");
  check_fails("matte(half)", "0.5", "no value");
}

TEST_CASE("an example whose recursion does not end fails with its line") {
  const Outcome run = test("/// >>> f($time)\n/// 1\nreal f(real x) =\n    f(x + 1);\n");
  CHECK(run.exit == 1);
  CHECK(contains(run.err, "s.mms:4: recursion does not end"));
}

TEST_CASE("an example of a material need only link") {
  CHECK(test("/// >>> paint(0.5)\nmaterial paint(real x) = matte(x);\n").exit == 0);
  CHECK(test("/// >>> paint(mirror())\nmaterial paint(real x) = matte(x);\n").exit == 1);
}

TEST_CASE("several examples in one comment, and text around them") {
  const Outcome run = test(
      "/// Adds.\n/// >>> add(1, 2)\n/// 3\n/// >>> add(1,\n///\n/// More text.\n"
      "/// >>> add(2, 2)\n/// 5\ninteger add(integer a, b) = a + b;\n");
  CHECK(run.exit == 1);
  CHECK(run.out == "s.mms: 3 examples, 2 failed\n");
  CHECK(contains(run.err, "s.mms:4: "));
  CHECK(contains(run.err, "s.mms:7: "));
}

TEST_CASE("an example sees params, settings, imports and values of many lines") {
  const Folder folder;
  folder.write("part.mms", "real twice(real x) = 2 * x;\n");
  folder.write("s.mms",
               "import \"part.mms\";\nparam real k = 1.0;\n"
               "/// >>> [twice(k), $time,\n/// 1\nreal unused_here() = 1;\n"
               "/// >>> [twice(k), $time]\n/// [6,\n///  7]\nreal other() = 1;\n");
  const Outcome run = folder.mms("test --set k=3 --set time=7 s.mms");
  CHECK(run.out == "s.mms: 2 examples, 1 failed\n");
  CHECK(contains(run.err, "s.mms:3: "));
}

TEST_CASE("each example is an object on a line for pipelines") {
  const Outcome run = test("/// >>> 1 + 1\n/// 3\nreal x() = 1;\n", "--format=json");
  CHECK(run.exit == 1);
  CHECK(json::parse(run.out) == json({{"file", "s.mms"},
                                      {"line", 1},
                                      {"expression", "1 + 1"},
                                      {"expected", "3"},
                                      {"found", "2"},
                                      {"passed", false}}));
}

TEST_CASE("a script with errors is not tested") {
  const Outcome run = test("/// >>> 1\n/// 1\nreal f( = 1;\n");
  CHECK(run.exit == 1);
  CHECK(run.out == "");
  CHECK(contains(run.err, "s.mms:3:"));
}

TEST_CASE("the examples of the library hold") {
  const Folder folder;
  for (const char* module : {"math", "physics", "materials"}) {
    INFO(module);
    CHECK(folder.mms(std::string("test ") + module).exit == 0);
  }
  for (const auto& e : fs::directory_iterator(mms::source_dir() / "stdlib")) {
    if (e.path().extension() != ".mms") continue;
    INFO(e.path().string());
    const Outcome run = folder.mms("test " + e.path().stem().string());
    INFO(run.err);
    CHECK(run.exit == 0);
    CHECK(contains(run.out, ", 0 failed"));
  }
}

TEST_CASE("every documented function of the library's modules has an example") {
  for (const auto& e : fs::directory_iterator(mms::source_dir() / "stdlib")) {
    if (e.path().extension() != ".mms") continue;
    std::ifstream in(e.path());
    bool documented = false, shown = false;
    for (std::string line; std::getline(in, line);) {
      const bool doc = line.starts_with("///");
      INFO(e.path().string(), ": ", line);
      if (!doc && documented) CHECK(shown);
      shown = doc && (shown || line.starts_with("/// >>> "));
      documented = doc;
    }
  }
}

#if MMS_RENDERER

TEST_CASE("the commands that render the figures run, at a small size") {
  const fs::path root = mms::source_dir();
  int commands = 0;
  for (const auto& entry : fs::directory_iterator(root / "examples/figures")) {
    std::ifstream script(entry.path());
    for (std::string line; std::getline(script, line);) {
      const std::size_t at = line.find("mms render ");
      if (!line.starts_with("//") || at == std::string::npos) continue;
      std::istringstream words(line.substr(at + 4));
      std::string command;
      for (std::string word; words >> word;) {
        if (word == "--size" || word == "--samples") {
          words >> word;
          continue;
        }
        if (word == "-o") break;
        if (word.ends_with(".mms") || word.ends_with(".json"))
          word = (entry.path().parent_path() / fs::path(word).filename()).string();
        command += word + " ";
      }
      const Folder folder;
      const Outcome run = folder.mms(command + "--size 16x12 --samples 1 -o a.png");
      CHECK_MESSAGE(run.exit == 0, command, run.err);
      CHECK_MESSAGE(folder.has("a.png"), command);
      ++commands;
    }
  }
  CHECK(commands >= 15);
}

#endif
