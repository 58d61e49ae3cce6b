// SPDX-License-Identifier: Apache-2.0
// mms doc: the reference pages and the manuals of scripts, printed, written, or compared with what
// is there.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/library.h"
#include "base/file.h"
#include "lang/parser.h"
#include "tools/commands.h"
#include "tools/document.h"
#include "tools/html.h"
#include "tools/script.h"
#include "tools/script_document.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;

struct DocOptions : ScriptOptions {
  std::string page, write, check;
  bool html = false;
};

std::string rendered(const std::string& markdown, const DocOptions& options) {
  return options.html ? html_page(markdown) : markdown;
}

fs::path page_path(const std::string& folder, const Document& page, const DocOptions& options) {
  return fs::path(folder) / fmt::format("{}.{}", page.name, options.html ? "html" : "md");
}

Exit write_pages(const DocOptions& options) {
  for (const Document& page : documents()) {
    const fs::path path = page_path(options.write, page, options);
    if (const auto error = replace_file(path.string(), rendered(page.text(), options)))
      return fail(Exit::File, {error->where, error->what, "name a folder that exists"}, options);
  }
  return Exit::Ok;
}

/// Compares every page with its file: Script where one differs, File where one is missing.
Exit check_pages(const DocOptions& options) {
  Exit exit = Exit::Ok;
  for (const Document& page : documents()) {
    const fs::path path = page_path(options.check, page, options);
    std::ifstream in(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in && text == rendered(page.text(), options)) continue;
    exit = fail(in ? Exit::Script : Exit::File,
                {path.string(), in ? "is not what the tables say" : "cannot be read",
                 "./run document writes it anew"},
                options);
  }
  return exit;
}

Exit print_script(const DocOptions& options) {
  const Result<lang::SourcePtr> source = api::read_source(options.page);
  if (!source) return fail(Exit::File, source.error(), options);
  lang::Diagnostics diagnostics;
  const lang::Graph graph = lang::parse(*source, diagnostics);
  print(diagnostics, options);
  if (diagnostics.has_errors()) return Exit::Script;
  fmt::print("{}", rendered(script_document(graph), options));
  return Exit::Ok;
}

/// A page that is written by hand: as HTML it goes with the others.
Exit print_markdown(const DocOptions& options) {
  const Result<lang::SourcePtr> page = api::read_source(options.page);
  if (!page) return fail(Exit::File, page.error(), options);
  fmt::print("{}", rendered(std::string((*page)->text), options));
  return Exit::Ok;
}

Exit print_page(const DocOptions& options) {
  if (options.page == "-" || options.page.ends_with(".mms")) return print_script(options);
  if (options.page.ends_with(".md")) return print_markdown(options);
  std::vector<std::string> names, entries;
  for (const Document& page : documents()) {
    if (page.name == options.page) {
      fmt::print("{}", rendered(page.text(), options));
      return Exit::Ok;
    }
    names.emplace_back(page.name);
  }
  for (const auto& [name, text] : entry_documents()) {
    if (name == options.page) {
      fmt::print("{}", rendered(text, options));
      return Exit::Ok;
    }
    entries.push_back(name);
  }
  std::string near = lang::nearest(options.page, names);
  if (near.empty()) near = lang::nearest(options.page, entries);
  return fail(Exit::Usage,
              {"mms doc", fmt::format("no page, function or variable is called `{}`", options.page),
               near.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                            : fmt::format("did you mean `{}`?", near)},
              options);
}

Exit doc(const DocOptions& options) {
  if (!options.write.empty()) return write_pages(options);
  if (!options.check.empty()) return check_pages(options);
  if (!options.page.empty()) return print_page(options);
  for (const Document& page : documents()) fmt::print("{:<10}{}\n", page.name, page.doc);
  return Exit::Ok;
}

}  // namespace

Verb doc_verb() {
  auto options = std::make_shared<DocOptions>();
  Verb verb{
      "doc",
      "Print a page of the reference or the manual of a script, or list the pages",
      "The manual of a script is made of its /// comments. The options of linking are taken as\n"
      "by every verb that reads scripts; the manual does not depend on them.\n\nExamples:\n  mms "
      "doc\n"
      "  mms doc stdlib | less\n  mms doc --html marble.mms > marble.html",
      {},
      [options] { return doc(*options); }};
  verb.add({"PAGE", &options->page, "",
            "The page, a script (*.mms, - is standard input) or a page of your own (*.md); none "
            "lists the pages"});
  verb.add({"--html", &options->html, "", "As one HTML page with a search box, not as Markdown"});
  verb.add({"--write", &options->write, "DIR", "Write all pages to a folder"});
  verb.add({"--check", &options->check, "DIR", "Fail if a page in a folder is out of date"});
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
