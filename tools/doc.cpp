// SPDX-License-Identifier: Apache-2.0
// mms doc: the reference pages, printed, written, or compared with what is there.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/diagnostics.h"
#include "tools/commands.h"
#include "tools/document.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;

struct DocOptions {
  std::string page, write, check;
};

fs::path page_path(const std::string& folder, const Document& page) {
  return fs::path(folder) / fmt::format("{}.md", page.name);
}

Exit write_pages(const std::string& folder) {
  for (const Document& page : documents()) {
    const fs::path path = page_path(folder, page);
    std::ofstream out(path, std::ios::binary);
    out << page.text();
    out.close();
    if (!out) {
      print_error({path.string(), "cannot be written", "name a folder that exists"});
      return Exit::File;
    }
  }
  return Exit::Ok;
}

/// Compares every page with its file: Script where one differs, File where one is missing.
Exit check_pages(const std::string& folder) {
  Exit exit = Exit::Ok;
  for (const Document& page : documents()) {
    const fs::path path = page_path(folder, page);
    std::ifstream in(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in && text == page.text()) continue;
    print_error({path.string(), in ? "is not what the tables say" : "cannot be read",
                 "./run document writes it anew"});
    exit = in ? Exit::Script : Exit::File;
  }
  return exit;
}

Exit print_page(const std::string& name) {
  std::vector<std::string> names;
  for (const Document& page : documents()) {
    if (page.name == name) {
      fmt::print("{}", page.text());
      return Exit::Ok;
    }
    names.emplace_back(page.name);
  }
  const std::string near = lang::nearest(name, names);
  print_error({"mms doc", fmt::format("no page is called `{}`", name),
               near.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                            : fmt::format("did you mean `{}`?", near)});
  return Exit::Usage;
}

Exit doc(const DocOptions& options) {
  if (!options.write.empty()) return write_pages(options.write);
  if (!options.check.empty()) return check_pages(options.check);
  if (!options.page.empty()) return print_page(options.page);
  for (const Document& page : documents()) fmt::print("{:<10}{}\n", page.name, page.doc);
  return Exit::Ok;
}

}  // namespace

Verb doc_verb() {
  auto options = std::make_shared<DocOptions>();
  Verb verb{"doc",
            "Print a page of the reference, or list the pages",
            "Examples:\n  mms doc\n  mms doc stdlib | less",
            {},
            [options] { return doc(*options); }};
  verb.add({"PAGE", &options->page, "", "The page; none lists them"});
  verb.add({"--write", &options->write, "DIR", "Write all pages to a folder"});
  verb.add({"--check", &options->check, "DIR", "Fail if a page in a folder is out of date"});
  return verb;
}

}  // namespace mms::tools
