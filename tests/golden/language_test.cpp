// SPDX-License-Identifier: Apache-2.0
// Every example of docs/language.md: blocks marked `mms` link without a message, and where a
// comment says `// = V` that is the value; blocks marked `mms error=E0203` give that error.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "tests/golden/expectations.h"
#include "tests/source_dir.h"

namespace mms::golden {
namespace {

struct Block {
  int line = 0;
  std::string info, text;
};

std::vector<Block> blocks_of(const std::string& path) {
  std::ifstream in(path);
  REQUIRE(in);
  std::vector<Block> all;
  bool inside = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) all.push_back({number, line.substr(3), {}});
    } else if (inside) {
      all.back().text += line + "\n";
    }
  }
  CHECK(!inside);
  return all;
}

TEST_CASE("the examples of docs/language.md") {
  int linked = 0, wrong = 0;
  for (const Block& b : blocks_of((mms::source_dir() / "docs/language.md").string())) {
    if (!b.info.starts_with("mms")) continue;
    CAPTURE(b.line);
    std::string text = b.text;
    const std::string mark = "// = ";
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at))
      text.replace(at, mark.size(), "// expect: ");
    const auto source = lang::make_source("language.md", text);
    if (b.info == "mms") {
      ++linked;
      std::string all;
      for (const std::string& f : examine(source).failures) all += f + "\n";
      CHECK_MESSAGE(all.empty(), all);
      continue;
    }
    ++wrong;
    const std::string prefix = "mms error=";
    REQUIRE(b.info.starts_with(prefix));
    const Compiled c = compile(source);
    REQUIRE(!c.diagnostics.all().empty());
    CHECK(lang::info(c.diagnostics.all()[0].id).code == b.info.substr(prefix.size()));
  }
  CHECK(linked > 10);
  CHECK(wrong > 1);
}

}  // namespace
}  // namespace mms::golden
