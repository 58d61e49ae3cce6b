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
#include "tools/commands.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

struct NamedEntry {
  const char* name;
  const vm::Entry vm::Descriptor::*entry;
};
constexpr NamedEntry kEntries[] = {{"shade", &vm::Descriptor::shade},
                                   {"pass", &vm::Descriptor::pass},
                                   {"emit", &vm::Descriptor::emit},
                                   {"displace", &vm::Descriptor::displace}};

std::size_t instructions(const vm::Program& program, const vm::Entry& entry) {
  return entry.function ? program.functions[*entry.function].code.size() : 0;
}

/// What is read, as scripts name it: a hidden variable stands for the wavelength it is made of.
std::vector<std::string> variables(std::uint32_t bits) {
  std::vector<std::string> names;
  for (const vm::VariableInfo& row : vm::kVariables) {
    if (!(bits >> static_cast<unsigned>(row.variable) & 1u)) continue;
    const bool hidden = row.visibility == vm::Visibility::Hidden;
    std::string name =
        fmt::format("${}", hidden ? vm::info(vm::Variable::Wavelength).name : row.name);
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

Json to_json(const vm::Program& program, const vm::Descriptor& d) {
  Json json;
  json["form"] = d.form == vm::DescriptorForm::Surface ? "surface" : "volume";
  json["name"] = d.name;
  json["file"] = d.line.source < program.sources.size() ? program.sources[d.line.source] : "";
  json["line"] = d.line.line;
  for (const NamedEntry& e : kEntries)
    json["instructions"][e.name] = instructions(program, d.*e.entry);
  for (int i = 0; i < static_cast<int>(vm::Output::Count); ++i) {
    const auto output = static_cast<vm::Output>(i);
    const std::string name(api::output_name(d.form, output));
    if (name.empty()) continue;
    const vm::OutputInfo& info = d.output(output);
    Json& o = json["outputs"][name];
    o["stated"] = info.stated;
    o["constant"] = info.constant;
    o["spectral"] = info.spectral;
    o["reads"] = variables(info.variables);
    if (const std::string text = material(d, output); !text.empty()) {
      o["material"] = text;
      if (output == vm::Output::Material)
        if (const double most = api::largest_weight(program, d); std::isfinite(most))
          o["largest_weight"] = most;
    }
  }
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

void print_text(const lang::Linked& linked) {
  for (const lang::ParamInfo& p : linked.params) {
    fmt::print("param {} {} = {}", p.type, p.name, fmt::join(p.value, ", "));
    if (p.range) fmt::print(" in [{}, {}]", p.range->first, p.range->second);
    fmt::print("{}{}\n", p.label.empty() ? "" : "  ", p.label);
  }
  for (const vm::Descriptor& d : linked.program.descriptors) {
    const Json json = to_json(linked.program, d);
    fmt::print("{} {}  ({}:{})\n", json["form"].get<std::string>(), d.name,
               json["file"].get<std::string>(), d.line.line);
    for (const auto& [name, o] : json["outputs"].items()) {
      std::string line = fmt::format("  {:<18}{:<9}{:<9}", name, o["stated"] ? "stated" : "default",
                                     o["constant"] ? "constant" : "varying");
      if (o["spectral"]) line += " spectral";
      if (o.contains("material")) line += " " + o["material"].get<std::string>();
      if (!o["reads"].empty())
        line +=
            fmt::format(" reads {}", fmt::join(o["reads"].get<std::vector<std::string>>(), " "));
      fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
      if (o.contains("material")) print_weight(o);
    }
    fmt::print("  instructions     ");
    for (const auto& [name, count] : json["instructions"].items())
      fmt::print(" {} {}", name, count.get<std::size_t>());
    fmt::print("\n");
  }
}

Exit info(const ScriptOptions& options) {
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  if (!options.json()) {
    print_text(*linked);
    return exit;
  }
  Json json{{"params", Json::array()},
            {"descriptors", Json::array()},
            {"dependencies", linked->dependencies}};
  for (const lang::ParamInfo& p : linked->params) json["params"].push_back(to_json(p));
  for (const vm::Descriptor& d : linked->program.descriptors)
    json["descriptors"].push_back(to_json(linked->program, d));
  fmt::print("{}\n", json.dump(2));
  return exit;
}

}  // namespace

Verb info_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"info",
            "Tell what a linked script knows about itself",
            "Examples:\n  mms info marble.mms\n  mms info --format=json marble.mms | jq .params",
            {},
            [options] { return info(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
