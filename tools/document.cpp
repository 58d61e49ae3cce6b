// SPDX-License-Identifier: Apache-2.0
#include "tools/document.h"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/library.h"
#include "lang/parser.h"
#include "tools/command.h"
#include "vm/limits.h"

namespace mms::tools {

namespace {

constexpr Document kDocuments[] = {
    {"stdlib", "every function and material of the library", stdlib_document},
    {"inputs", "the `$variables`", inputs_document},
    {"errors", "every message, explained", errors_document},
    {"bytecode", "the instructions of the machine", bytecode_document},
    {"cli", "the command, its verbs and its exit codes", cli_document},
};

constexpr std::string_view kMade =
    "<!-- Made by `./run document`; change the table, not the page. -->\n";

/// Text that stands in a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string_view or_dash(std::string_view text) { return text.empty() ? "-" : text; }

std::string accuracy(const vm::Builtin& row) {
  if (row.max_ulp == 0) return "";
  return fmt::format(" Within {:g} ulp in float.", row.max_ulp);
}

/// How close its enclosure is; docs/bounds.md says what the words mean.
std::string_view enclosed(const vm::Builtin& row) {
  switch (row.bounds.form) {
    case vm::BoundsForm::None:
      break;
    case vm::BoundsForm::Range:
      return " Bounds: range.";
    case vm::BoundsForm::Lipschitz:
      return " Bounds: Lipschitz.";
    case vm::BoundsForm::Parts:
      return " Bounds: parts.";
    case vm::BoundsForm::Exact:
      return " Bounds: exact.";
  }
  return "";
}

std::string entry(const vm::Builtin& row) {
  std::string text =
      fmt::format("`{}`\n\n{}{}{}\n", row.signature, row.doc, accuracy(row), enclosed(row));
  if (!row.example.empty()) text += fmt::format("\n```\n{}\n```\n", row.example);
  return text + "\n";
}

/// The functions of a module that is written in the language, from its doc comments.
std::string module_entries(const lang::Library::Module& module) {
  lang::Diagnostics diagnostics;
  const lang::SourcePtr source =
      lang::make_source(std::string(module.name) + ".mms", std::string(module.text));
  const lang::Graph graph = lang::parse(source, diagnostics);
  std::string text;
  for (const lang::FunctionHandle handle : graph.top_functions) {
    const lang::Function& f = graph[handle];
    if (f.doc.empty()) continue;
    text += fmt::format("`{}`\n\n{}\n\n",
                        source->text.substr(f.header.begin, f.header.end - f.header.begin), f.doc);
  }
  return text;
}

}  // namespace

std::span<const Document> documents() { return kDocuments; }

std::string stdlib_document() {
  std::map<std::string, std::string> modules;  // sorted by name
  const lang::Library& library = api::standard_library();
  for (const vm::Builtin& row : library.builtins)
    modules[std::string(row.lobe >= 0 ? "materials" : row.module)] += entry(row);
  for (const lang::Library::Module& m : library.modules)
    if (const std::string text = module_entries(m); !text.empty())
      modules[std::string(m.name)] += text;
  std::string text = fmt::format(
      "# The library\n\n{}\nEvery function can be called by its bare name; "
      "`import \"MODULE\" as m;` makes `m::NAME` of those of one module.\n",
      kMade);
  for (const auto& [name, entries] : modules) text += fmt::format("\n## {}\n\n{}", name, entries);
  text.pop_back();
  return text;
}

std::string inputs_document() {
  std::string text = fmt::format(
      "# Variables\n\n{}\nWhat a script can see of the point that is shaded.\n\n"
      "| Name | Type | Space | Unit | Meaning |\n|---|---|---|---|---|\n",
      kMade);
  for (const vm::VariableInfo& row : vm::kVariables)
    if (row.visibility == vm::Visibility::Public)
      text += fmt::format("| `${}` | `{}` | {} | {} | {} |\n", row.name, row.type,
                          or_dash(row.space), row.unit, cell(row.doc));
  return text;
}

std::string errors_document() {
  std::string text = fmt::format(
      "# Messages\n\n{}\n`mms explain CODE` prints an entry of this page. With `--format=json` "
      "each message is one object on one line:\n\n"
      "| Member | Value |\n|---|---|\n"
      "| `code`, `name` | as below; codes are never reused |\n"
      "| `severity` | `error` or `warning` |\n"
      "| `message` | the sentence |\n"
      "| `file`, `line`, `column`, `end_line`, `end_column` | where; from 1, columns in characters "
      "|\n"
      "| `label` | what stands beside the carets |\n"
      "| `notes` | other places: objects with the same five members and `text` |\n"
      "| `helps` | what to try: strings |\n",
      kMade);
  for (const lang::DiagInfo& row : lang::all_diagnostics())
    text += fmt::format("\n## {} {}\n\n{}: {}\n\n{}\n", row.code, row.name,
                        row.severity == lang::Severity::Error ? "error" : "warning", row.text,
                        row.explain);
  return text;
}

std::string bytecode_document() {
  std::string text = fmt::format(
      "# Bytecode\n\n{}\nThe machine's portable form is typed stack code. Letters are the types of "
      "values on the stack, the bottom first: `r` real, `i` integer, `l` logic, `s` spectrum; `?` "
      "where the operand decides. In the meaning, `a`, `b`, `c` are what is popped, or the "
      "operands. Cost is in units of one real addition.\n\n"
      "| Instruction | Operand | Pops | Pushes | Cost | Meaning |\n|---|---|---|---|---|---|\n",
      kMade);
  constexpr std::string_view kOperands[] = {"-",          "constant", "input",   "local",
                                            "block type", "function", "builtin", "wavelength"};
  for (const vm::OpInfo& row : vm::kOps)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name,
                        kOperands[static_cast<std::size_t>(row.operand)], or_dash(row.pops),
                        or_dash(row.pushes), row.cost, cell(row.doc));
  text += fmt::format(
      "\n## Limits\n\nA lane may take {} back edges and recursive calls in one run, and have {} "
      "calls open at a time; calls in tail position do not count. A material holds at most {} "
      "scattering models and combiners.\n",
      vm::limits::kBackEdges, vm::limits::kCallDepth, vm::limits::kLobes);
  return text;
}

std::string cli_document() {
  std::string text = fmt::format(
      "# The command\n\n{}\n```\n{}```\n\n## Exit codes\n\n| Code | Meaning |\n|---|---|\n", kMade,
      command_help());
  for (const ExitInfo& row : kExits)
    text += fmt::format("| {} | {} |\n", static_cast<int>(row.code), row.doc);
  const std::vector<std::string> helps = verb_helps();
  const std::vector<Verb> all = verbs();
  for (std::size_t i = 0; i < all.size(); ++i)
    text += fmt::format("\n## mms {}\n\n```\n{}```\n", all[i].name, helps[i]);
  return text;
}

}  // namespace mms::tools
