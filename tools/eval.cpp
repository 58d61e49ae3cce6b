// SPDX-License-Identifier: Apache-2.0
// mms eval: the value of an expression, or of the constants of a script.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/accuracy.h"
#include "api/excerpts.h"
#include "tools/commands.h"
#include "tools/evaluate.h"
#include "vm/trace.h"

namespace mms::tools {

namespace {

constexpr const char* kName = "eval_result";

struct EvalOptions : ScriptOptions {
  std::string item;
  std::string precision = "float";
  bool trace = false;
};

std::string value_text(const vm::TracedValue& v, bool single) {
  const auto number = [&](double x) -> std::string {
    if (x != x) return "nan";
    return single ? fmt::format("{}", static_cast<float>(x)) : fmt::format("{}", x);
  };
  if (v.type == vm::SlotType::Real) return number(v.real[0]);
  if (v.type == vm::SlotType::Integer) return fmt::format("{}", v.integer);
  if (v.type == vm::SlotType::Logic) return v.integer ? "true" : "false";
  std::vector<std::string> parts;
  for (const double x : v.real) parts.push_back(number(x));
  return fmt::format("spectrum({})", fmt::join(parts, ", "));
}

/// One line for each value: where, what the source says there, the value.
template <class R>
void print_trace(const vm::Program& program, std::uint32_t function, vm::InputBatch<R>& in,
                 api::Excerpts& excerpts) {
  const vm::Trace trace = vm::trace(program, function, in, 0);
  constexpr bool single = sizeof(R) == sizeof(float);
  for (const vm::TraceStep& s : trace.steps) {
    const vm::Op op = program.functions[s.function].code[s.instruction].op;
    fmt::print("{:<20} {:<12} {:<44} {}{}\n", api::place(program, s.line), vm::info(op).name,
               excerpts.from_column(s.line),
               std::string(2 * static_cast<std::size_t>(s.depth), ' '),
               value_text(s.value, single));
  }
  if (trace.step_count > trace.steps.size())
    fmt::print("... and {} more\n", trace.step_count - trace.steps.size());
  for (const vm::TracedValue& v : trace.results)
    if (v.origin >= 0) {
      const vm::SourceLine at = trace.origins[static_cast<std::size_t>(v.origin)].line;
      fmt::print("{} was first made at {}: {}\n", value_text(v, single), api::place(program, at),
                 excerpts.line(at));
    }
}

/// Prints `expression`, or every value that the scripts export where it is empty.
template <class R>
Exit print_values(const Compiled& compiled, const EvalOptions& options,
                  const std::string& expression, const std::vector<lang::SourcePtr>& sources) {
  Exit exit = Exit::Ok;
  auto in = point<R>(compiled, options, exit);
  if (!in) return exit;
  api::Excerpts excerpts(compiled.program, sources);
  bool printed = expression.empty();
  for (const vm::Export& e : compiled.program.exports) {
    if (!expression.empty() && e.name != kName) continue;
    const auto value = evaluate(compiled.program, e, *in);
    if (!value) return fail(Exit::Budget, value.error(), options);
    printed = true;
    if (options.trace) print_trace(compiled.program, e.function, *in, excerpts);
    if (expression.empty()) fmt::print("{} = ", e.name);
    fmt::print("{}\n", value->text);
  }
  if (!printed)
    return fail(Exit::Script,
                {expression, "has no value that can be printed",
                 "materials and functions exist only while linking; `mms render` shows a material"},
                options);
  return Exit::Ok;
}

Exit eval(const EvalOptions& options) {
  std::vector<std::string> files = options.files;
  std::string expression = options.item;
  if (expression.find_first_not_of(" \t\n") == std::string::npos)
    return fail(Exit::Usage,
                {"mms eval", "the expression is empty", "for example: mms eval '2^0.5'"}, options);
  if (expression == "-" || expression.ends_with(".mms") || expression.ends_with(".mmsc")) {
    files.push_back(expression);
    expression.clear();
  }
  Exit exit = Exit::Ok;
  auto sources = read_sources(files, options, exit);
  if (!sources) return exit;
  // A comment at the end must not take the semicolon with it.
  const char* end = expression.find("//") == std::string::npos ? "" : "\n";
  if (!expression.empty())
    sources->push_back(lang::make_source(
        "<expression>", fmt::format("const {} = {}{};\n", kName, expression, end)));
  const auto compiled = compile(*sources, options, exit);
  if (!compiled) return exit;
  return options.precision == "double"
             ? print_values<double>(*compiled, options, expression, *sources)
             : print_values<float>(*compiled, options, expression, *sources);
}

}  // namespace

Verb eval_verb() {
  auto options = std::make_shared<EvalOptions>();
  options->at_points = true;
  Verb verb{
      "eval",
      "Print the value of an expression, or of a script's constants",
      "Variables are set in SI units. What is not set is the north pole of a unit sphere seen "
      "from above.\n\nExamples:\n"
      "  mms eval '2^0.5'\n  mms eval --set position=[1,2,3] 'perlin($position)'\n"
      "  mms eval --set wavelength=550nm 'bk7()'\n  mms eval -- '-1 % 3'\n"
      "  mms eval --trace -O0 --set position=[0,0,0] 'sqrt($position.x) / $position.y'\n"
      "  mms eval -f marble.mms --set scale=2 'ridged($object_position, 6, 0.5, 0.0)'",
      {},
      [options] { return eval(*options); }};
  verb.add({"EXPRESSION",
            &options->item,
            "",
            "An expression; or a script (*.mms, *.mmsc, - is standard input) to print constants of",
            {},
            true});
  verb.add({"-f,--file", &options->files, "FILE", "A script whose names the expression may use"});
  verb.add({"--precision",
            &options->precision,
            "TYPE",
            "float, as in pictures, or double",
            {"float", "double"}});
  verb.add({"--trace", &options->trace, "", "Print every value on the way, with its source"});
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
