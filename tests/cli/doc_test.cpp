// SPDX-License-Identifier: Apache-2.0
// mms doc: manuals of scripts, and pages as HTML.
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kScript =
    "/// How large.\nparam real scale = 2.0 in [1, 9];\n"
    "/// Half of `x`, if x < 3 & more.\n/// >>> half(3.0)\n/// 1.5\n"
    "real half(real x) = x / 2;\n"
    "/// Grey.\nsurface s\n    bsdf = matte(half(1.0));\nend\n";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What is wrong with the nesting of the elements of a page, or empty.
std::string nesting_fault(const std::string& html) {
  static const std::set<std::string> empty{"meta", "input", "!DOCTYPE"};
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    if (!open.empty() && (open.back() == "style" || open.back() == "script") &&
        html.compare(at, 2, "</") != 0)
      continue;
    const std::size_t end = html.find_first_of(" >", at);
    const std::string name = html.substr(at + 1, end - at - 1);
    if (empty.contains(name)) continue;
    if (name[0] != '/') {
      open.push_back(name);
    } else if (open.empty() || open.back() != name.substr(1)) {
      return name + " closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is left open";
}

/// The values of every attribute `name`.
std::set<std::string> attributes(const std::string& html, const std::string& name) {
  std::set<std::string> all;
  const std::string mark = " " + name + "=\"";
  for (std::size_t at = html.find(mark); at != html.npos; at = html.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    all.insert(html.substr(begin, html.find('"', begin) - begin));
  }
  return all;
}

}  // namespace

TEST_CASE("the manual of a script is made of its comments") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const Outcome run = folder.mms("doc s.mms");
  CHECK(run.exit == 0);
  CHECK(run.out ==
        "# s.mms\n\n## Surfaces\n\n`surface s`\n\nGrey.\n\n"
        "## Params\n\n`param real scale = 2.0 in [1, 9]`\n\nHow large.\n\n"
        "## Functions\n\n`real half(real x)`\n\nHalf of `x`, if x < 3 & more.\n\n"
        "```\n>>> half(3.0)\n1.5\n```\n");
  CHECK(folder.mms("doc -", kScript).exit == 0);
  CHECK(folder.mms("doc missing.mms").exit == 3);
  CHECK(folder.mms("doc -", "surface").exit == 1);
}

TEST_CASE("HTML of a script is escaped") {
  const Folder folder;
  const std::string html = folder.mms("doc --html -", kScript).out;
  CHECK(contains(html, "<code>x</code>, if x &lt; 3 &amp; more."));
  CHECK(contains(html, "<h3><code>real half(real x)</code></h3>"));
  CHECK(contains(html, "<pre><code>&gt;&gt;&gt; half(3.0)\n1.5\n</code></pre>"));
  const std::string wild = folder
                               .mms("doc --html -",
                                    "/// <script>alert(1)</script> [x](javascript:alert(1))\n"
                                    "const a = 1;\n")
                               .out;
  CHECK_FALSE(contains(wild, "<script>alert"));
  CHECK_FALSE(contains(wild, "href=\"javascript"));
}

TEST_CASE("every page is one HTML file that needs nothing else, and its index leads somewhere") {
  const Folder folder;
  for (const char* page : {"stdlib", "inputs", "errors", "bytecode", "cli", "info", "passes"}) {
    const std::string html = folder.mms(std::string("doc --html ") + page).out;
    INFO(page);
    CHECK(html.starts_with("<!DOCTYPE html>"));
    CHECK(nesting_fault(html) == "");
    CHECK(attributes(html, "src").empty());
    CHECK_FALSE(contains(html, "<link"));
    CHECK_FALSE(contains(html, "@import"));
    CHECK_FALSE(contains(html, ":url("));
    CHECK_FALSE(contains(html, ": url("));
    const std::set<std::string> ids = attributes(html, "id");
    for (const std::string& target : attributes(html, "href"))
      if (target.starts_with("#")) CHECK(ids.contains(target.substr(1)));
  }
  const std::string html = folder.mms("doc --html stdlib").out;
  CHECK(contains(html, "<input type=\"search\""));
  CHECK(contains(html, "<h3><code>material matte(spectrum colour = 1)</code></h3>"));
  CHECK(attributes(html, "id").size() > 100);
}

TEST_CASE("pages are written and compared as HTML too") {
  const Folder folder;
  CHECK(folder.mms("doc --html --write .").exit == 0);
  CHECK(folder.has("stdlib.html"));
  CHECK(folder.mms("doc --html --check .").exit == 0);
  CHECK(folder.mms("doc --check .").exit == 3);
  CHECK(folder.mms("doc --write no/such/folder").exit == 3);
}
