// SPDX-License-Identifier: Apache-2.0
// mms info: what a linked program knows about itself.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/bounds.h"
#include "api/outputs.h"
#include "materials/table.h"
#include "tools/commands.h"
#include "tools/dependencies.h"
#include "tools/script.h"
#include "vm/facts.h"

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

/// Grows when a member of the JSON goes or means something else; new members do not count.
constexpr int kSchema = 1;

struct InfoOptions : ScriptOptions {
  DepsOption deps;
};

constexpr std::pair<materials::Trait, const char*> kTraitNames[] = {
    {materials::Reflects, "reflects"},     {materials::Transmits, "transmits"},
    {materials::Specular, "specular"},     {materials::Polished, "polished"},
    {materials::Dispersive, "dispersive"}, {materials::Combiner, "combiner"},
    {materials::PhaseFunction, "phase"}};

constexpr const char* kRates[] = {"constant", "uniform", "varying"};

/// A variable as scripts name it: a hidden one stands for what it is the change of, or for the
/// wavelength it is made of.
std::string_view visible_name(const vm::VariableInfo& row) {
  if (row.visibility != vm::Visibility::Hidden) return row.name;
  for (const vm::VariableInfo& moving : vm::kVariables)
    if (row.name == moving.along_tangent || row.name == moving.along_bitangent) return moving.name;
  return vm::info(vm::Variable::Wavelength).name;
}

std::vector<std::string> variables(std::uint32_t bits) {
  std::vector<std::string> names;
  for (const vm::VariableInfo& row : vm::kVariables) {
    if (!(bits >> static_cast<unsigned>(row.variable) & 1u)) continue;
    std::string name = fmt::format("${}", visible_name(row));
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  }
  return names;
}

/// `fresnel_mix(matte, glossy)`: the tree below node `at`, without its numbers.
std::string tree(const vm::MaterialLayout& layout, std::size_t at) {
  const vm::LayoutNode& node = layout.nodes[at];
  std::string text(api::lobe_name(node.lobe));
  for (std::size_t i = 0; i < node.children.size(); ++i)
    text += (i ? ", " : "(") + tree(layout, node.children[i]);
  return node.children.empty() ? text : text + ")";
}

std::string material(const vm::Descriptor& d, vm::Output output) {
  const auto source = api::material_source(d, output);
  if (!source || source->layout->nodes.empty()) return "";
  return tree(*source->layout, source->layout->nodes.size() - 1);
}

/// The models and combiners of a material: what they can do, by the table of traits.
Json lobes(const vm::Descriptor& d, vm::Output output) {
  Json all = Json::array();
  const auto source = api::material_source(d, output);
  if (!source) return all;
  for (const vm::LayoutNode& node : source->layout->nodes) {
    const unsigned bits = materials::traits(static_cast<materials::Lobe>(node.lobe));
    Json traits = Json::array();
    for (const auto& [trait, name] : kTraitNames)
      if (bits & trait) traits.push_back(name);
    all.push_back({{"name", api::lobe_name(node.lobe)}, {"traits", traits}});
  }
  return all;
}

Json output_json(const vm::Program& program, const vm::Descriptor& d, vm::Output output) {
  const vm::OutputInfo& info = d.output(output);
  Json json{{"stated", info.stated},
            {"rate", kRates[static_cast<int>(vm::rate(info))]},
            {"spectral", info.spectral},
            {"reads", variables(info.variables)}};
  if (const std::string text = material(d, output); !text.empty()) {
    json["material"] = text;
    json["reciprocal"] = vm::reciprocal(info);
    json["lobes"] = lobes(d, output);
    if (output == vm::Output::Material)
      if (const double most = api::largest_weight(program, d); std::isfinite(most))
        json["largest_weight"] = most;
  }
  return json;
}

/// One way to run the descriptor; nothing but zeros where all its values are constants.
Json entry_json(const vm::Entry& entry, const std::vector<vm::CodeFacts>& facts) {
  const vm::CodeFacts f = entry.function ? facts[*entry.function] : vm::CodeFacts{};
  return {{"instructions", f.instructions},
          {"cost", f.cost},
          {"calls", f.calls},
          {"back_edges", f.back_edges},
          {"stack_blocks", f.stack_blocks},
          {"recursion", f.recursive ? "calls"
                        : f.loops   ? "tail"
                                    : "none"}};
}

Json to_json(const vm::Program& program, const vm::Descriptor& d,
             const std::vector<vm::CodeFacts>& facts) {
  Json json{{"form", d.form == vm::DescriptorForm::Surface ? "surface" : "volume"},
            {"name", d.name},
            {"file", d.line.source < program.sources.size() ? program.sources[d.line.source] : ""},
            {"line", d.line.line},
            {"reciprocal", vm::reciprocal(d)}};
  for (int i = 0; i < static_cast<int>(vm::Output::Count); ++i) {
    const auto output = static_cast<vm::Output>(i);
    const std::string name(api::output_name(d.form, output));
    if (!name.empty()) json["outputs"][name] = output_json(program, d, output);
  }
  for (const api::NamedEntry& e : api::kEntries)
    json["entries"][e.name] = entry_json(d.*e.entry, facts);
  return json;
}

Json to_json(const lang::ParamInfo& p) {
  Json json{{"name", p.name}, {"type", p.type}, {"value", p.value}};
  if (p.range) json["range"] = {p.range->first, p.range->second};
  json["label"] = p.label;
  json["unit"] = p.unit;
  json["page"] = p.page;
  json["doc"] = p.doc;
  return json;
}

/// What is proven of a material's weights (api/bounds.h); rounding may pass 1 by a little.
void print_weight(const Json& o) {
  if (!o.contains("largest_weight")) return;
  const double most = o["largest_weight"].get<double>();
  if (most <= 1 + 1e-5)
    fmt::print("  {:<18}proven: weights never exceed one (at most {:.4g})\n", "", most);
  else
    fmt::print("  {:<18}not proven that weights never exceed one (at most {:.4g})\n", "", most);
}

void print_descriptor(const Json& json) {
  fmt::print("{} {}  ({}:{}){}\n", json["form"].get<std::string>(), json["name"].get<std::string>(),
             json["file"].get<std::string>(), json["line"].get<int>(),
             json["reciprocal"] ? "" : " not reciprocal");
  for (const auto& [name, o] : json["outputs"].items()) {
    std::string line = fmt::format("  {:<18}{:<9}{:<9}", name, o["stated"] ? "stated" : "default",
                                   o["rate"].get<std::string>());
    if (o["spectral"]) line += " spectral";
    if (o.contains("material")) line += " " + o["material"].get<std::string>();
    if (!o["reads"].empty())
      line += fmt::format(" reads {}", fmt::join(o["reads"].get<std::vector<std::string>>(), " "));
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
    print_weight(o);
  }
  fmt::print("  {:<18}{:>12}{:>8}{:>8}{:>8}{:>12}  recursion\n", "entry", "instructions", "cost",
             "stack", "calls", "back edges");
  for (const auto& [name, e] : json["entries"].items())
    fmt::print("  {:<18}{:>12}{:>8}{:>8}{:>8}{:>12}  {}\n", name, e["instructions"].dump(),
               e["cost"].dump(), e["stack_blocks"].dump(), e["calls"].dump(),
               e["back_edges"].dump(), e["recursion"].get<std::string>());
}

void print_text(const lang::Linked& linked) {
  for (const lang::ParamInfo& p : linked.params) {
    fmt::print("param {} {} = {}", p.type, p.name, fmt::join(p.value, ", "));
    if (p.range) fmt::print(" in [{}, {}]", p.range->first, p.range->second);
    fmt::print("{}{}\n", p.label.empty() ? "" : "  ", p.label);
  }
  const std::vector<vm::CodeFacts> facts = vm::code_facts(linked.program);
  for (const vm::Descriptor& d : linked.program.descriptors)
    print_descriptor(to_json(linked.program, d, facts));
}

Exit info(const InfoOptions& options) {
  Exit exit = Exit::Ok;
  ScriptOptions compiling = options;
  compiling.format = "text";  // standard output is for the one object
  const auto linked = compile_files(options.files, compiling, exit);
  if (!linked) return exit;
  if (!options.deps.form.empty()) {
    print_deps(options.files.front(), *linked, options.deps, options);
    return exit;
  }
  if (!options.json()) {
    print_text(*linked);
    return exit;
  }
  Json json{{"schema", kSchema},
            {"params", Json::array()},
            {"descriptors", Json::array()},
            {"dependencies", linked->dependencies}};
  for (const lang::ParamInfo& p : linked->params) json["params"].push_back(to_json(p));
  const std::vector<vm::CodeFacts> facts = vm::code_facts(linked->program);
  for (const vm::Descriptor& d : linked->program.descriptors)
    json["descriptors"].push_back(to_json(linked->program, d, facts));
  // Names of files, and all in a stored program, may be no UTF-8.
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  return exit;
}

}  // namespace

Verb info_verb() {
  auto options = std::make_shared<InfoOptions>();
  Verb verb{
      "info",
      "Tell what a linked script knows about itself",
      "`mms doc info` describes the columns and the JSON.\n\nExamples:\n  mms info marble.mms\n"
      "  mms info --format=json marble.mms | jq .params\n  mms info --deps marble.mms",
      {},
      [options] { return info(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_deps_option(verb, options->deps);
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
