// SPDX-License-Identifier: Apache-2.0
#include "tools/document.h"

#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/library.h"
#include "lang/parser.h"
#include "tools/command.h"
#include "tools/doc_comment.h"
#include "vm/limits.h"
#include "vm/serialise.h"

namespace mms::tools {

namespace {

constexpr Document kDocuments[] = {
    {"stdlib", "every function and material of the library", stdlib_document},
    {"inputs", "the `$variables`", inputs_document},
    {"errors", "every message, explained", errors_document},
    {"bytecode", "the instructions of the machine", bytecode_document},
    {"cli", "the command, its verbs and its exit codes", cli_document},
    {"info", "what `mms info` prints, and its JSON", info_document},
    {"passes", "what the optimiser does, in order", passes_document},
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
  return fmt::format(" Within {:g} ulp in float{}{}.", row.max_ulp, row.domain.empty() ? "" : ": ",
                     row.domain);
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

/// Of `real perlin(real x)`: perlin.
std::string name_of(std::string_view header) {
  const std::string_view call = header.substr(0, header.find('('));
  return std::string(call.substr(call.rfind(' ') + 1));
}

/// The picture of a noise or a pattern: examples/figures/library.mms has a surface of its name.
/// Later functions of the same name have none.
class Pictures {
 public:
  std::string of(std::string_view header) {
    const std::string name = name_of(header);
    constexpr std::string_view kPictured = MMS_PICTURED;
    if (kPictured.find(" " + name + " ") == kPictured.npos || !shown_.insert(name).second)
      return "";
    return fmt::format("![{0}](images/library/{0}.png)\n\n", name);
  }

 private:
  std::set<std::string> shown_;
};

std::string entry(const vm::Builtin& row, Pictures& pictures) {
  std::string text = fmt::format("`{}`\n\n{}{}{}{}\n", row.signature, pictures.of(row.signature),
                                 row.doc, accuracy(row), enclosed(row));
  if (!row.example.empty()) text += fmt::format("\n```\n{}\n```\n", row.example);
  return text + "\n";
}

/// The names and entries of the functions of a module that is written in the language, from its
/// doc comments.
std::vector<std::pair<std::string, std::string>> module_entries(const lang::Library::Module& module,
                                                                Pictures& pictures) {
  lang::Diagnostics diagnostics;
  const lang::SourcePtr source =
      lang::make_source(std::string(module.name) + ".mms", std::string(module.text));
  const lang::Graph graph = lang::parse(source, diagnostics);
  std::vector<std::pair<std::string, std::string>> entries;
  for (const lang::FunctionHandle handle : graph.top_functions) {
    const lang::Function& f = graph[handle];
    if (f.doc.empty()) continue;
    const std::string header(lang::text_of(f.header));
    entries.emplace_back(name_of(header), fmt::format("`{}`\n\n{}{}\n", header, pictures.of(header),
                                                      doc_markdown(f.doc)));
  }
  return entries;
}

}  // namespace

std::span<const Document> documents() { return kDocuments; }

std::map<std::string, std::string> entry_documents() {
  std::map<std::string, std::string> all;
  const lang::Library& library = api::standard_library();
  Pictures pictures;
  for (const vm::Builtin& row : library.builtins)
    all[name_of(row.signature)] += entry(row, pictures);
  for (const lang::Library::Module& m : library.modules)
    for (const auto& [name, text] : module_entries(m, pictures)) all[name] += text;
  for (const vm::VariableInfo& row : vm::kVariables)
    if (row.visibility == vm::Visibility::Public)
      all["$" + std::string(row.name)] =
          fmt::format("`{} ${}`\n\n{} Space: {}, unit: {}.\n", row.type, row.name, row.doc,
                      or_dash(row.space), row.unit);
  return all;
}

std::string stdlib_document() {
  std::map<std::string, std::string> modules;  // sorted by name
  const lang::Library& library = api::standard_library();
  Pictures pictures;
  for (const vm::Builtin& row : library.builtins)
    modules[std::string(row.lobe >= 0 ? "materials" : row.module)] += entry(row, pictures);
  for (const lang::Library::Module& m : library.modules)
    for (const auto& [name, text] : module_entries(m, pictures))
      modules[std::string(m.name)] += text;
  std::string text = fmt::format(
      "# The library\n\n{}\nEvery function can be called by its bare name; "
      "`import \"MODULE\" as m;` makes `m::NAME` of those of one module. Noises and patterns have "
      "a "
      "picture, 5 units wide (`examples/figures/library.mms`); [the gallery](gallery.md) shows "
      "what "
      "can be made of them.\n",
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

namespace {

std::string members_table(std::span<const lang::JsonMember> members) {
  std::string text = "| Member | Value |\n|---|---|\n";
  for (const lang::JsonMember& m : members)
    text += fmt::format("| `{}` | {} |\n", m.name, cell(m.doc));
  return text;
}

}  // namespace

std::string errors_document() {
  std::string text = fmt::format(
      "# Messages\n\n{}\n`mms explain CODE` prints an entry of this page.\n\n"
      "## JSON\n\nWith `--format=json` each message is one object on one line. Its members, all of "
      "them always there and in this order:\n\n{}\nAnd of an object in `notes`:\n\n{}\n"
      "Members may be added in later versions; these keep their names and meaning.\n",
      kMade, members_table(lang::json_members()), members_table(lang::json_note_members()));
  for (const lang::DiagInfo& row : lang::all_diagnostics()) text += "\n## " + lang::page(row);
  return text;
}

std::string bytecode_document() {
  std::string text = fmt::format(
      "# Bytecode\n\n{}\nThe machine's portable form is typed stack code. Letters are the types of "
      "values on the stack, the bottom first: `r` real, `i` integer, `l` logic, `s` spectrum; `?` "
      "where the operand decides. In the meaning, `a`, `b`, `c` are what is popped, or the "
      "operands. Cost is in units of one real addition.\n\n"
      "| Instruction | Operand | Pops | Pushes | Cost | Meaning | Derivative |\n"
      "|---|---|---|---|---|---|---|\n",
      kMade);
  constexpr std::string_view kOperands[] = {"-",          "constant", "input",   "local",
                                            "block type", "function", "builtin", "wavelength"};
  static_assert(std::size(kOperands) == static_cast<std::size_t>(vm::OperandForm::Wavelength) + 1);
  for (const vm::OpInfo& row : vm::kOps)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", row.name,
                        kOperands[static_cast<std::size_t>(row.operand)], or_dash(row.pops),
                        or_dash(row.pushes), row.cost, cell(row.doc), or_dash(row.derivative));
  text += fmt::format(
      "\n## Limits\n\nA lane may take {} back edges and recursive calls in one run, and have {} "
      "calls open at a time; calls in tail position do not count. A material holds at most {} "
      "scattering models and combiners.\n",
      vm::limits::kBackEdges, vm::limits::kCallDepth, vm::limits::kLobes);
  return text + "\n## Stored programs\n\n" + vm::format_document();
}

std::string info_document() {
  return fmt::format("# What a program knows about itself\n\n{}{}", kMade, R"(
`mms info` prints it; with `--format=json` as one object. `schema` is a number that grows when a
member goes or means something else; new members may come without that.

| Member | Value |
|---|---|
| `schema` | 1 |
| `params` | each `param`: `name`, `type`, `value` (numbers, flattened), `range` (two numbers, if stated), `label`, `unit`, `page`, `doc` |
| `descriptors` | each surface and volume, as below |
| `dependencies` | the files that are imported, directly or not |

A descriptor:

| Member | Value |
|---|---|
| `form`, `name`, `file`, `line` | `surface` or `volume`, and where it stands |
| `reciprocal` | whether light is scattered alike in both directions: bsdf or phase, scattering, absorption, height and gradient read none of `$view`, `$distance`, `$footprint` |
| `outputs` | by name, as below |
| `entries` | `shade` (what a path vertex needs), `pass` (a shadow ray), `emit` (an emitter), `displace`: as below |

An output:

| Member | Value |
|---|---|
| `stated` | whether the author wrote it, or it was derived from what the author wrote |
| `rate` | `constant`: reads no variable (params are folded at link). `uniform`: reads only what is the same for a whole frame, `$time`. `varying`: anything else |
| `spectral` | whether it depends on the wavelength |
| `reads` | the variables it depends on |
| `material`, `reciprocal`, `lobes` | of materials: the tree of models and combiners; whether it reads nothing of the ray; each node's `name` and `traits`: `reflects`, `transmits`, `specular`, `polished` (specular where its roughness says so), `dispersive`, `combiner`, `phase` |
| `largest_weight` | of a material: the most that its weights can add up to, as proven over the unit sphere (`mms bounds`); not there where nothing is proven |

An entry, or zeros where all its values are constants and nothing is run:

| Member | Value |
|---|---|
| `instructions` | of its function and all that it reaches, each function once |
| `cost` | in units of one real addition: both arms of each choice, each loop once, each recursion one level deep |
| `stack_blocks` | bound of what the frames of all open calls take: numbers for each point |
| `calls` | most calls open at a time; calls in tail position are none |
| `back_edges` | most tail calls and recursive calls of a point; 0 where there is no loop |
| `recursion` | `none`, `tail` or `calls`. Where it is not `none`, the machine's limits are the bounds |
)");
}

std::string passes_document() {
  std::string text = fmt::format(
      "# Passes\n\n{}\nWhat the optimiser does with each function, in order. No pass changes a "
      "value. "
      "`mms disasm --dump-after=NAME` prints the linker's graph after one.\n\n"
      "| Pass | From | What it does |\n|---|---|---|\n",
      kMade);
  for (const lang::PassInfo& pass : lang::passes())
    text += fmt::format("| `{}` | -O{} | {} |\n", pass.name, static_cast<int>(pass.from),
                        cell(pass.doc));
  text +=
      "\nThe bytecode that comes out is lowered when it is loaded: operands are read where they "
      "lie,\nslots are used again, library calls that depend on the frame alone run once for a "
      "batch\n(uniformity), tail calls become loops, and frequent pairs of operations one. "
      "`mms disasm` shows\nit beside the source.\n";
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
