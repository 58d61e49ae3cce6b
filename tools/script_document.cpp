// SPDX-License-Identifier: Apache-2.0
#include "tools/script_document.h"

#include <filesystem>

#include <fmt/format.h>

#include "tools/doc_comment.h"

namespace mms::tools {

namespace {

/// The first line of what a span holds, without what ends it.
std::string header_of(lang::Span span) {
  std::string_view text = text_of(span);
  text = text.substr(0, text.find('\n'));
  return std::string(text.substr(0, text.find_last_not_of(" \t\r;") + 1));
}

std::string entry(const std::string& header, const std::string& doc) {
  return fmt::format("`{}`\n\n{}{}", header, doc_markdown(doc), doc.empty() ? "" : "\n");
}

/// A part with a heading, where there is anything in it.
std::string part(const char* heading, const std::string& entries) {
  return entries.empty() ? "" : fmt::format("## {}\n\n{}", heading, entries);
}

}  // namespace

std::string script_document(const lang::Graph& graph) {
  std::string surfaces, volumes, params, functions, constants, types;
  for (const lang::Descriptor& d : graph.descriptors) {
    const bool surface = d.form == lang::Descriptor::Form::Surface;
    (surface ? surfaces : volumes) +=
        entry(fmt::format("{} {}", surface ? "surface" : "volume", d.name.text), d.doc);
  }
  for (const lang::Param& p : graph.params) params += entry(header_of(p.span), p.doc);
  for (const lang::FunctionHandle f : graph.top_functions)
    functions += entry(std::string(text_of(graph[f].header)), graph[f].doc);
  for (const lang::Constant& k : graph.constants) constants += entry(header_of(k.span), k.doc);
  for (const lang::TypeDefinition& t : graph.type_definitions)
    types += entry(header_of(t.span), t.doc);
  std::string text =
      fmt::format("# {}\n\n", std::filesystem::path(graph.source->name).filename().string()) +
      part("Surfaces", surfaces) + part("Volumes", volumes) + part("Params", params) +
      part("Functions", functions) + part("Constants", constants) + part("Types", types);
  text.pop_back();
  return text;
}

}  // namespace mms::tools
