// SPDX-License-Identifier: Apache-2.0
// mms bounds: what a script's outputs can be, anywhere in a box.
#include <algorithm>
#include <charconv>
#include <cmath>
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
using vm::Interval;

struct BoundsOptions : ScriptOptions {
  std::vector<std::string> over, outputs;
  std::string grid = "1";
};

/// `[0,1],[2,3]` or `0.5` or `[0,1],0.5`: a number is an interval of itself.
bool parse_intervals(std::string text, std::vector<double>& lo, std::vector<double>& hi) {
  std::erase(text, ' ');
  const char* at = text.data();
  const char* end = at + text.size();
  const auto number = [&](double& value) {
    const auto [next, error] = std::from_chars(at, end, value);
    at = next;
    return error == std::errc();
  };
  const auto skip = [&](char c) { return at < end && *at == c ? (++at, true) : false; };
  while (at < end) {
    double a = 0, b = 0;
    if (skip('[')) {
      if (!number(a) || !skip(',') || !number(b) || !skip(']')) return false;
    } else {
      if (!number(a)) return false;
      b = a;
    }
    lo.push_back(a);
    hi.push_back(b);
    if (at < end && (!skip(',') || at == end)) return false;
  }
  return !lo.empty();
}

Result<vm::Variable> set(vm::Box& box, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == 0 || at == text.npos)
    return Error{"--over", fmt::format("`{}` is not a setting", text),
                 "write --over position=[-1,1],[0,0.5],2"};
  const std::string name = text.substr(0, at), intervals = text.substr(at + 1);
  std::vector<double> lo, hi;
  if (!parse_intervals(intervals, lo, hi))
    return Error{"--over", fmt::format("`{}` is no list of intervals", intervals),
                 "for example position=[-1,1],[0,0.5],2"};
  auto r = api::set_box(box, name, lo, hi);
  if (!r) return Error{"--over", fmt::format("{}: {}", name, r.error().what), r.error().hint};
  return r;
}

/// An end of an interval: infinities are no numbers in JSON.
Json end(double x) { return std::isfinite(x) ? Json(x) : Json(x > 0 ? "inf" : "-inf"); }

Json to_json(const api::OutputBounds& b) {
  Json json{{"lo", Json::array()}, {"hi", Json::array()}, {"nan", false}, {"widened", b.widened}};
  for (const Interval& i : b.values) {
    json["lo"].push_back(end(i.lo));
    json["hi"].push_back(end(i.hi));
    if (i.nan) json["nan"] = true;
  }
  return json;
}

std::string to_text(const api::OutputBounds& b) {
  std::vector<std::string> parts;
  for (const Interval& i : b.values)
    parts.push_back(i.has_number() ? fmt::format("[{:.9g}, {:.9g}]", i.lo, i.hi) : "NaN");
  std::string text = fmt::format("{}", fmt::join(parts, ", "));
  for (const Interval& i : b.values)
    if (i.nan && i.has_number()) return text + ", or NaN" + (b.widened ? "  (widened)" : "");
  return text + (b.widened ? "  (widened)" : "");
}

bool wanted(const BoundsOptions& options, std::string_view name) {
  return options.outputs.empty() ||
         std::find(options.outputs.begin(), options.outputs.end(), name) != options.outputs.end();
}

/// Prints or collects the outputs of one descriptor; how many there were.
int show(const vm::Program& program, const vm::Descriptor& d, const BoundsOptions& options,
         const vm::Box& box, int grid, Json& all) {
  Json json{{"form", d.form == vm::DescriptorForm::Surface ? "surface" : "volume"},
            {"name", d.name},
            {"outputs", Json::object()}};
  std::string text;
  for (int i = 0; i < static_cast<int>(vm::Output::Count); ++i) {
    const auto output = static_cast<vm::Output>(i);
    const std::string name(api::output_name(d.form, output));
    const bool asked = !options.outputs.empty() && wanted(options, name);
    if (name.empty() || !wanted(options, name) || (!asked && !d.output(output).stated)) continue;
    const api::OutputBounds b = api::output_bounds(program, d, output, box, grid);
    if (b.values.empty()) continue;
    json["outputs"][name] = to_json(b);
    text += fmt::format("  {:<12}{}\n", name, to_text(b));
  }
  const int found = int(json["outputs"].size());
  if (!options.json() && found > 0)
    fmt::print("{} {}\n{}", json["form"].get<std::string>(), d.name, text);
  all.push_back(std::move(json));
  return found;
}

Exit bounds(const BoundsOptions& options) {
  int grid = 0;
  const auto [next, error] =
      std::from_chars(options.grid.data(), options.grid.data() + options.grid.size(), grid);
  if (error != std::errc() || *next != 0 || grid < 1 || grid > 1024)
    return fail(
        Exit::Usage,
        {"--grid", "`" + options.grid + "` parts along an axis", "a whole number from 1 to 1024"},
        options);
  vm::Box box = vm::Box::unit_sphere();
  for (const std::string& text : options.over)
    if (const auto done = set(box, text); !done) return fail(Exit::Usage, done.error(), options);
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  Json all = Json::array();
  int found = 0;
  for (const vm::Descriptor& d : linked->program.descriptors)
    found += show(linked->program, d, options, box, grid, all);
  if (options.json()) fmt::print("{}\n", all.dump(2));
  if (found == 0 && !options.outputs.empty())
    return fail(Exit::Script,
                {options.files[0], "no descriptor has such an output that is made of numbers",
                 "try height, gradient, bound, scattering, absorption or emission"},
                options);
  if (found == 0 && !options.json())
    fmt::print("no output made of numbers is stated; --output shows the others\n");
  return exit;
}

}  // namespace

Verb bounds_verb() {
  auto options = std::make_shared<BoundsOptions>();
  Verb verb{"bounds",
            "Enclose the outputs of a script over a box of points",
            "Without --over the box is the unit sphere's: positions, normals and directions in\n"
            "[-1, 1], $uv in [0, 1], time 0, wavelengths from 360 to 830 nm. An interval stands\n"
            "for every component; so does a number, which is an interval of itself.\n"
            "Examples:\n  mms bounds marble.mms\n"
            "  mms bounds --output height --grid 16 tiles.mms\n"
            "  mms bounds --over 'object_position=[0,0.1],[0,0.1],0' --format=json marble.mms",
            {},
            [options] { return bounds(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  verb.add({"--over", &options->over, "NAME=[LO,HI],...",
            "What a $variable can be; SI units, an interval for each component"});
  verb.add(
      {"--output", &options->outputs, "NAME", "Only this output, also where it is not stated"});
  verb.add({"--grid", &options->grid, "N",
            "Cut positions into N parts along each axis, for tighter bounds"});
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
