// SPDX-License-Identifier: Apache-2.0
// The folder listing is the architecture: includes run one way. And CONTRIBUTING.md lists what
// tests read from the environment.
#include "tests/structure/includes.h"
#include "tests/source_dir.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;
using namespace mms::structure;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const Rules& rules() {
  static const Rules all = read_rules(read(mms::source_dir() / "ARCHITECTURE.md"));
  return all;
}

bool is_source(const fs::path& path) {
  const std::string e = path.extension().string();
  return e == ".h" || e == ".cpp" || e == ".c" || e == ".def" || e == ".inc";
}

}  // namespace

TEST_CASE("the table has a row for every folder of sources") {
  for (const char* folder : {"base", "vm", "lang", "materials", "stdlib", "api", "renderer",
                             "tools", "bench", "tests"}) {
    INFO(folder);
    CHECK(rules().contains(folder));
  }
  CHECK(rules().at("base").folders == std::set<std::string>{"base"});
  CHECK(rules().at("vm").folders == std::set<std::string>{"base", "vm"});
  CHECK_FALSE(rules().at("lang").folders.contains("stdlib"));
  CHECK(rules().at("api").folders.size() == 6);
}

TEST_CASE("every include of the sources is allowed") {
  std::size_t files = 0;
  for (const auto& [folder, rule] : rules()) {
    const fs::path root = mms::source_dir() / folder;
    if (!fs::exists(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      ++files;
      const std::string path = fs::relative(entry.path(), mms::source_dir()).generic_string();
      for (const std::string& complaint : check(rules(), path, read(entry.path())))
        FAIL_CHECK(complaint);
    }
  }
  CHECK(files > 50);  // the walk found the sources
}

TEST_CASE("a wrong include is found") {
  CHECK(check(rules(), "vm/x.cpp", "#include \"base/vec.h\"\n#include <vector>\n").empty());
  const auto upward = check(rules(), "vm/x.cpp", "\n#include \"lang/parser.h\"\n");
  REQUIRE(upward.size() == 1);
  CHECK(upward[0] == "vm/x.cpp:2: vm/ may not include lang/");
  CHECK(check(rules(), "lang/x.cpp", "#  include \"stdlib/stdlib.h\"").size() == 1);
  CHECK(check(rules(), "base/x.h", "#include <vm/types.h>").size() == 1);
  CHECK(check(rules(), "unknown/x.h", "").size() == 1);
}

TEST_CASE("third-party headers stand where the table says") {
  CHECK(check(rules(), "renderer/x.cpp", "#include <embree3/rtcore.h>").empty());
  CHECK(check(rules(), "renderer/x.h", "#include <embree3/rtcore.h>").size() == 1);
  CHECK(check(rules(), "renderer/x.h", "#include <OpenImageIO/imageio.h>").size() == 1);
  CHECK(check(rules(), "tools/x.cpp", "#include <OpenImageIO/imageio.h>").size() == 1);
  CHECK(check(rules(), "base/x.cpp", "#include <fmt/format.h>").size() == 1);
  CHECK(check(rules(), "tests/x.cpp", "#include <doctest/doctest.h>").empty());
}

TEST_CASE("CONTRIBUTING.md lists every variable that a test reads, and no other") {
  const auto all = [](const std::string& text, const char* pattern) {
    const std::regex name(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it)
      names.insert((*it)[1]);
    return names;
  };
  std::set<std::string> read_by_tests;
  for (const auto& entry : fs::recursive_directory_iterator(mms::source_dir() / "tests"))
    if (entry.is_regular_file() && is_source(entry.path()))
      read_by_tests.merge(
          all(read(entry.path()), "(?:getenv|setting)\\(\"(MMS_[A-Z_]+)\""));
  CHECK(read_by_tests.contains("MMS_KILLS"));
  CHECK(read_by_tests ==
        all(read(mms::source_dir() / "CONTRIBUTING.md"), "\n\\| `(MMS_[A-Z_]+)` \\|"));
}
