// SPDX-License-Identifier: Apache-2.0
// mms doc: manuals of scripts, and pages as HTML.
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/cli/command.h"
#include "tests/source_dir.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kScript =
    "/// How large.\nparam real scale = 2.0 in [1, 9];\n"
    "/// Half of `x`, if x < 3 & more.\n/// >>> half(3.0)\n/// 1.5\n"
    "real half(real x) = x / 2;\n"
    "/// Grey.\nsurface s\n    bsdf = matte(half(1.0));\nend\n";

/// What is wrong with the nesting of the elements of a page, or empty.
std::string nesting_fault(const std::string& html) {
  static const std::set<std::string> empty{"meta", "img", "input", "!DOCTYPE"};
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

TEST_CASE("doc prints what the library says of a function, and explain the page of a warning") {
  const Folder folder;
  const Outcome all = folder.mms("doc stdlib"), perlin = folder.mms("doc perlin");
  INFO(perlin.err);
  CHECK(perlin.exit == 0);
  CHECK(perlin.out.starts_with("`real perlin(real x)`\n"));
  CHECK(contains(perlin.out, "`real perlin(real[2] p)`\n"));
  CHECK_FALSE(contains(perlin.out, "`real perlin_gradient("));
  CHECK(contains(all.out, perlin.out.substr(0, perlin.out.find("`real perlin(real[2]"))));
  CHECK(contains(folder.mms("doc matte").out, "material matte("));
  CHECK(folder.mms("doc '$uv'").out ==
        "`real[2] $uv`\n\nSurface parameters, each usually in [0, 1]. Space: texture, unit: 1.\n");
  CHECK(contains(folder.mms("doc '$normall'").err, "did you mean `$normal`?"));
  CHECK(contains(folder.mms("explain unused-param").out, "W0404"));
  CHECK(folder.mms("explain unused").out == folder.mms("explain W0401").out);
}

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

TEST_CASE(
    "every page is one HTML file that needs nothing else but thumbnails, and its index leads "
    "somewhere") {
  const Folder folder;
  std::vector<std::string> pages;  // the generated ones are in docs/ too
  for (const auto& file : std::filesystem::directory_iterator(mms::source_dir() / "docs"))
    if (file.path().extension() == ".md") pages.push_back(file.path().string());
  CHECK(pages.size() >= 14);
  for (const std::string& page : pages) {
    INFO(page);
    const Outcome ran = folder.mms("doc --html " + page);
    CHECK(ran.exit == 0);
    const std::string& html = ran.out;
    CHECK(html.starts_with("<!DOCTYPE html>"));
    CHECK(nesting_fault(html) == "");
    for (const std::string& source : attributes(html, "src"))
      CHECK(std::filesystem::exists(mms::source_dir() / "docs/" / source));
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

TEST_CASE("every noise and pattern of the library has its picture") {
  namespace fs = std::filesystem;
  const fs::path root = mms::source_dir();
  const std::string script = mms::cli::project_text("examples/figures/library.mms");
  const std::string page = mms::cli::project_text("docs/stdlib.md");
  std::size_t count = 0;
  std::uintmax_t bytes = 0;
  for (std::size_t at = 0; (at = script.find("\nsurface ", at)) != script.npos; ++at, ++count) {
    const std::size_t begin = at + 9, end = script.find_first_of(" \n", begin);
    const std::string name = script.substr(begin, end - begin);
    INFO(name);
    const std::string picture = "images/library/" + name + ".png";
    CHECK(fs::exists(root / "docs" / picture));
    if (fs::exists(root / "docs" / picture)) bytes += fs::file_size(root / "docs" / picture);
    CHECK(contains(page, "![" + name + "](" + picture + ")"));
  }
  CHECK(count >= 52);
  CHECK(bytes < 1'000'000);
  // What is no picture of its own: how others are filtered, moved, laid out.
  const std::set<std::string> helpers = {"fade", "widest", "coverage", "turn"};
  for (const char* module : {"noise", "patterns"}) {
    std::istringstream source(mms::cli::project_text(std::string("stdlib/") + module + ".mms"));
    for (std::string line; std::getline(source, line);) {
      const std::size_t call = line.find('(');
      if (!line.starts_with("real") || call == line.npos) continue;
      const std::size_t space = line.rfind(' ', call);
      const std::string name = line.substr(space + 1, call - space - 1);
      INFO(module, ": ", name);
      CHECK((helpers.contains(name) || contains(script, "\nsurface " + name)));
    }
  }
}

TEST_CASE("the scripts of the gallery are laid out and link, and their pictures are there") {
  namespace fs = std::filesystem;
  const fs::path root = mms::source_dir();
  const Folder folder;
  for (const char* name : {"library", "noise", "fractals", "screen", "stained_glass", "copper",
                           "dispersion", "clusters", "illuminants", "frosted", "drink", "glossy"}) {
    const std::string script = (root / "examples/figures" / name).string() + ".mms";
    INFO(script);
    CHECK(folder.mms("check " + script).exit == 0);
    CHECK(folder.mms("fmt --check " + script).exit == 0);
    CHECK(folder.mms("test " + script).exit == 0);
  }
  for (const char* name : {"simple", "octaves", "sine", "exponential", "mandelbrot", "julia"})
    CHECK(fs::exists(root / "docs/images/figures" / (std::string(name) + ".png")));
}

TEST_CASE("pages are written and compared as HTML too") {
  const Folder folder;
  CHECK(folder.mms("doc --html --write .").exit == 0);
  CHECK(folder.has("stdlib.html"));
  CHECK(folder.mms("doc --html --check .").exit == 0);
  CHECK(folder.mms("doc --check .").exit == 3);
  CHECK(folder.mms("doc --write no/such/folder").exit == 3);
}
