// SPDX-License-Identifier: Apache-2.0
// mms furnace: what the surfaces and phase functions of a script do in a white furnace.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/outputs.h"
#include "base/file.h"
#include "materials/table.h"
#include "tools/commands.h"
#include "tools/evaluate.h"
#include "tools/furnace_report.h"
#include "tools/overwrite.h"
#include "tools/picture.h"

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

struct FurnaceOptions : ScriptOptions {
  std::string samples = "20000", plot, page;
};

/// Volumes whose phase function is stated, and surfaces but those without a `bsdf` of their own
/// that only hold such a volume.
bool is_of_interest(const vm::Descriptor& d, const vm::Program& program) {
  const bool stated = d.output(vm::Output::Material).stated;
  if (d.form == vm::DescriptorForm::Volume) return stated;
  return stated ||
         std::none_of(program.descriptors.begin(), program.descriptors.end(),
                      [&](const vm::Descriptor& other) {
                        return other.form == vm::DescriptorForm::Volume && other.name == d.name;
                      });
}

Exit furnace(const FurnaceOptions& options) {
  const long long count = number<long long>(options.samples).value_or(0);
  if (count < 1 || count > 100'000'000)
    return fail(Exit::Usage,
                {"--samples=" + options.samples, "is no number from 1 to 100000000",
                 "for example --samples=20000"},
                options);
  const int samples = int(count);
  Exit exit = Exit::Ok;
  ScriptOptions compiling = options;
  compiling.format = "text";  // standard output is for the one object
  const auto compiled = compile_files(options.files, compiling, exit);
  if (!compiled) return exit;
  std::vector<std::string> inputs = options.files;
  inputs.insert(inputs.end(), compiled->dependencies.begin(), compiled->dependencies.end());
  for (const std::string& output : {options.plot, options.page}) {
    if (output.empty()) continue;
    if (const auto error = check_replaceable(output)) return fail(Exit::File, *error, options);
    if (const auto error = overwrites(output, inputs)) return fail(Exit::Usage, *error, options);
  }
  auto in = point<double>(*compiled, options, exit);
  if (!in) return exit;
  std::vector<double> nanometres;
  for (int c = 0; c < kWavelengths; ++c)
    nanometres.push_back(in->lanes(vm::Variable::Wavelength, c)[0] * 1e9);
  std::vector<Furnace> all;
  for (const vm::Descriptor& d : compiled->program.descriptors) {
    const auto source = api::material_source(d, vm::Output::Material);
    if (!source || source->layout->nodes.empty() || !is_of_interest(d, compiled->program)) continue;
    const materials::Layout layout(*source->layout);
    all.push_back({d.form, d.name,
                   materials::furnace(
                       layout, api::material_numbers(compiled->program, *source, *in), samples)});
  }
  if (all.empty())
    return fail(Exit::Script,
                {options.files.front(), "has no surface with a material, and no phase function",
                 "write `surface s bsdf = matte(0.5); end`"},
                options);
  Json json{{"schema", 1}, {"samples", samples}, {"surfaces", Json::array()}};
  for (const Furnace& f : all) {
    if (options.json()) json["surfaces"].push_back(furnace_json(f, nanometres));
    if (!options.json()) fmt::print("{}", furnace_text(f, nanometres));
  }
  if (options.json()) fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  if (!options.plot.empty())
    if (const auto error = replace_file(options.plot, furnace_svg(all, nanometres)))
      return fail(Exit::File, *error, options);
  if (!options.page.empty())
    if (const auto error = replace_file(options.page, furnace_page(all)))
      return fail(Exit::File, *error, options);
  return exit;
}

}  // namespace

Verb furnace_verb() {
  auto options = std::make_shared<FurnaceOptions>();
  options->at_points = true;
  Verb verb{
      "furnace",
      "Measure how much light the surfaces of a script give back",
      "Each surface, and the phase function of each volume, is put into a white furnace: its "
      "albedo "
      "over the angle of incidence and the wavelength, 1 where it keeps all, and what is `lost` "
      "of 1 at the wavelength where that is most (negative: gained). `+-` is the standard error of "
      "the first column; `variance` that of a sample's weight, over the square of its mean: 0 is "
      "ideal sampling, and the efficiency 1 / (1 + variance). "
      "Variables are those of one point, as `mms eval` has them; above 90 degrees light comes from "
      "inside.\n\nExamples:\n"
      "  mms furnace gold.mms\n  mms furnace --samples=1000000 --set roughness=0.3 gold.mms\n"
      "  mms furnace --plot=gold.svg --format=json gold.mms | jq '.surfaces[0].rows[0].albedo'",
      {},
      [options] { return furnace(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  verb.add({"--samples", &options->samples, "N",
            "Samples for each direction and wavelength, 20000 unless given"});
  verb.add({"--plot", &options->plot, "PATH",
            "Write a plot as SVG, too: albedo over angle and wavelength, efficiency over angle"});
  verb.add({"--page", &options->page, "PATH",
            "Write a page of Markdown, too, as docs/materials.md: a table of each surface, under a "
            "picture images/materials/NAME.png"});
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
