// SPDX-License-Identifier: Apache-2.0
// mms furnace: what the surfaces of a script do in a white furnace.
#include "materials/furnace.h"

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

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

struct FurnaceOptions : ScriptOptions {
  std::string samples = "20000", plot;
};

struct Furnace {
  std::string name;
  materials::FurnaceReport report;
};

/// The numbers of the material of `d`, at the one point of `in`.
std::vector<double> numbers_of(const vm::Program& program, const api::MaterialSource& source,
                               vm::InputBatch<double>& in) {
  const vm::Executable executable(program);
  vm::Interpreter<double> machine(in.width());
  if (source.entry->function) machine.run(executable, *source.entry->function, in, 1);
  const auto value = [&](const vm::ValueSource& v, int c) -> double {
    if (v.constant) {
      const vm::Constant& constant = program.constants[v.index];
      return constant.type == vm::SlotType::Real ? constant.f64 : double(constant.integer);
    }
    const int k = static_cast<int>(v.index);
    if (v.type == vm::SlotType::Real) return machine.result(k)[0];
    if (v.type == vm::SlotType::Spectrum) return machine.result(k, c)[0];
    return machine.integer_result(k)[0];
  };
  std::vector<double> numbers;
  for (const vm::LayoutNode& node : source.layout->nodes) {
    const materials::Formals& formals = materials::formals(materials::Lobe(node.lobe));
    std::size_t next = 0;
    for (int k = 0; k < formals.count; ++k) {
      if (formals.kinds[k] == 'm') continue;
      const vm::ValueSource& v = node.params[next++];
      for (int c = 0; c < (formals.kinds[k] == 's' ? kWavelengths : 1); ++c)
        numbers.push_back(value(v, c));
    }
  }
  return numbers;
}

void print_text(const Furnace& furnace, const std::vector<double>& nanometres) {
  fmt::print("surface {}: reciprocal within {:.1e}\n  degrees", furnace.name,
             furnace.report.reciprocity);
  for (const double nm : nanometres) fmt::print("{:>6.0f} nm", nm);
  fmt::print("     +-  variance\n");
  for (const materials::FurnaceRow& row : furnace.report.rows) {
    fmt::print("  {:>7}", row.degrees);
    for (const double a : row.albedo.v) fmt::print("{:>9.5f}", a);
    fmt::print("{:>9.5f}{:>8.4f}\n", row.standard_error, row.relative_variance);
  }
}

Json to_json(const Furnace& furnace, const std::vector<double>& nanometres) {
  Json json{{"surface", furnace.name},
            {"reciprocity_error", furnace.report.reciprocity},
            {"wavelengths_nm", nanometres},
            {"rows", Json::array()}};
  for (const materials::FurnaceRow& row : furnace.report.rows)
    json["rows"].push_back({{"degrees", row.degrees},
                            {"albedo", row.albedo.v},
                            {"standard_error", row.standard_error},
                            {"relative_variance", row.relative_variance}});
  return json;
}

/// Albedo from 0 to 1.2 over degrees from 0 to 90 of the outside, a line for each wavelength.
std::string to_svg(const std::vector<Furnace>& all) {
  constexpr int width = 360, height = 240, left = 40, top = 30;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n",
      width + 2 * left, static_cast<int>(all.size()) * (height + 2 * top));
  int base = 0;
  for (const Furnace& f : all) {
    const auto y = [&](double albedo) { return base + top + height * (1 - albedo / 1.2); };
    svg += fmt::format("<text x=\"{}\" y=\"{}\">surface {}: albedo over degrees</text>\n", left,
                       base + top - 10, f.name);
    for (const double a : {0.0, 0.5, 1.0})
      svg += fmt::format(
          "<path d=\"M{} {:.1f}h{}\" stroke=\"#bbb\"/><text x=\"8\" y=\"{:.1f}\">{}</text>\n", left,
          y(a), width, y(a) + 4, a);
    for (const int degrees : {0, 30, 60, 90})
      svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", left + degrees * width / 90 - 6,
                         base + top + height + 14, degrees);
    for (int j = 0; j < kWavelengths; ++j) {
      std::string points;
      for (const materials::FurnaceRow& row : f.report.rows)
        if (row.degrees < 90)
          points +=
              fmt::format("{:.1f},{:.1f} ", left + row.degrees * width / 90, y(row.albedo[j]));
      svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"hsl({},80%,45%)\"/>\n",
                         points, 270 - 270 * j / (kWavelengths - 1));
    }
    base += height + 2 * top;
  }
  return svg + "</svg>\n";
}

Exit furnace(const FurnaceOptions& options) {
  const int samples = std::atoi(options.samples.c_str());
  if (samples < 1 || samples > 100'000'000)
    return fail(Exit::Usage,
                {"--samples=" + options.samples, "is no number from 1 to 100000000",
                 "for example --samples=20000"},
                options);
  Exit exit = Exit::Ok;
  ScriptOptions compiling = options;
  compiling.format = "text";  // standard output is for the one object
  const auto compiled = compile_files(options.files, compiling, exit);
  if (!compiled) return exit;
  auto in = point<double>(*compiled, options, exit);
  if (!in) return exit;
  std::vector<double> nanometres;
  for (int c = 0; c < kWavelengths; ++c)
    nanometres.push_back(in->lanes(vm::Variable::Wavelength, c)[0] * 1e9);
  std::vector<Furnace> all;
  for (const vm::Descriptor& d : compiled->program.descriptors) {
    const auto source = api::material_source(d, vm::Output::Material);
    if (d.form != vm::DescriptorForm::Surface || !source || source->layout->nodes.empty()) continue;
    const materials::Layout layout(*source->layout);
    all.push_back(
        {d.name, materials::furnace(layout, numbers_of(compiled->program, *source, *in), samples)});
  }
  if (all.empty())
    return fail(Exit::Script,
                {options.files.front(), "has no surface with a material",
                 "write `surface s bsdf = matte(0.5); end`"},
                options);
  Json json{{"schema", 1}, {"samples", samples}, {"surfaces", Json::array()}};
  for (const Furnace& f : all) {
    if (options.json()) json["surfaces"].push_back(to_json(f, nanometres));
    if (!options.json()) print_text(f, nanometres);
  }
  if (options.json()) fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  if (!options.plot.empty())
    if (const auto error = replace_file(options.plot, to_svg(all)))
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
      "Each surface is put into a white furnace: its albedo over the angle of incidence and the "
      "wavelength, 1 where it keeps all. `+-` is the standard error of the first column; "
      "`variance` that of a sample's weight, over the square of its mean: 0 is ideal sampling. "
      "Variables are those of one point, as `mms eval` has them; above 90 degrees light comes from "
      "inside.\n\nExamples:\n"
      "  mms furnace gold.mms\n  mms furnace --samples=1000000 --set roughness=0.3 gold.mms\n"
      "  mms furnace --plot=gold.svg --format=json gold.mms | jq '.surfaces[0].rows[0].albedo'",
      {},
      [options] { return furnace(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  verb.add({"--samples", &options->samples, "N",
            "Samples for each direction and wavelength, 20000 unless given"});
  verb.add({"--plot", &options->plot, "PATH", "Write a plot of the albedos as SVG, too"});
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
