// SPDX-License-Identifier: Apache-2.0
// What the README shows works.
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"
#include "tests/source_dir.h"

TEST_CASE("the script of the README has no errors and no warnings") {
  const std::string text = mms::cli::project_text("README.md");
  const std::string open = "```mms\n";
  const std::size_t begin = text.find(open);
  REQUIRE(begin != std::string::npos);
  const std::size_t end = text.find("```", begin + open.size());
  REQUIRE(end != std::string::npos);
  const mms::cli::Folder folder;
  folder.write("my.mms", text.substr(begin + open.size(), end - begin - open.size()));
  const mms::cli::Outcome run = folder.mms("check -Werror my.mms");
  INFO(run.err);
  CHECK(run.exit == 0);
  CHECK(run.err == "");
}

TEST_CASE("every page that the README links to is there") {
  const std::string text = mms::cli::project_text("README.md");
  int links = 0;
  for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
    const std::size_t end = text.find(')', at);
    REQUIRE(end != std::string::npos);
    const std::string target = text.substr(at + 2, end - at - 2);
    if (target.starts_with("http")) continue;
    INFO(target);
    CHECK(std::ifstream(mms::source_dir().string() + "/" + target).good());
    ++links;
  }
  CHECK(links >= 8);
}

TEST_CASE("the scripts of the tutorial and the README are laid out, and their examples hold") {
  int examples = 0;
  for (const std::string name : {"README.md", "docs/language.md"}) {
    std::string text = mms::cli::project_text(name);
    text = text.substr(0, text.find("## Reference\n"));
    const std::string open = "```mms\n";
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at + 1)) {
      const std::size_t begin = at + open.size();
      const mms::cli::Folder folder;
      folder.write("my.mms", text.substr(begin, text.find("```", begin) - begin));
      INFO(name, "\n", folder.read("my.mms"));
      CHECK(folder.mms("fmt --check my.mms").exit == 0);
      if (folder.read("my.mms").find(">>>") == std::string::npos) continue;
      CHECK(folder.mms("test my.mms").exit == 0);
      ++examples;
    }
  }
  CHECK(examples >= 1);
}
