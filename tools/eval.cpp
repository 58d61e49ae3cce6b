// SPDX-License-Identifier: Apache-2.0
// mms eval: the value of an expression, or of the constants of a script.
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/accuracy.h"
#include "api/excerpts.h"
#include "api/inputs.h"
#include "api/library.h"
#include "tools/commands.h"
#include "tools/script.h"
#include "vm/interpreter.h"
#include "vm/trace.h"

namespace mms::tools {

namespace {

constexpr const char* kName = "eval_result";

struct EvalOptions : ScriptOptions {
  std::string item;
  std::vector<std::string> settings;
  std::string precision = "float";
  bool trace = false;
};

/// `1, 2, 3` as numbers, or nothing.
bool parse_numbers(const std::string& text, std::vector<double>& numbers) {
  const char* at = text.data();
  const char* end = at + text.size();
  for (;;) {
    while (at < end && *at == ' ') ++at;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return false;
    numbers.push_back(value);
    at = next;
    while (at < end && *at == ' ') ++at;
    if (at == end) return true;
    if (*at++ != ',') return false;
  }
}

/// Sets a `$variable` as `--set name=1,2,3` says.
template <class R>
Result<api::Filled> set(vm::InputBatch<R>& in, const std::string& text) {
  const auto setting = split_setting("--set", text);
  if (!setting) return setting.error();
  std::string name = setting->first;
  if (name[0] == '$') name.erase(0, 1);
  const auto variable = api::find_variable(name);
  if (!variable) return Error{"--set", variable.error().what + ": " + name, variable.error().hint};
  std::vector<double> numbers;
  const auto count = static_cast<std::size_t>(api::value_count(*variable));
  if (!parse_numbers(setting->second, numbers) || (numbers.size() != count && numbers.size() != 1))
    return Error{
        "--set", fmt::format("`{}` is not a value of ${}", setting->second, name),
        fmt::format("it takes {} number{}, separated by commas", count, count > 1 ? "s" : "")};
  numbers.resize(count, numbers[0]);
  const std::vector<R> values(numbers.begin(), numbers.end());
  api::fill_all<R>(in, *variable, values);
  return api::Filled{};
}

/// Lane 0 of result `k` as text.
template <class R>
std::string value_text(const vm::Interpreter<R>& machine, vm::SlotType type, int k) {
  switch (type) {
    case vm::SlotType::Real:
      return fmt::format("{}", machine.result(k)[0]);
    case vm::SlotType::Integer:
      return fmt::format("{}", machine.integer_result(k)[0]);
    case vm::SlotType::Logic:
      return machine.integer_result(k)[0] ? "true" : "false";
    case vm::SlotType::Spectrum:
      break;
  }
  std::vector<R> values;
  for (int c = 0; c < kWavelengths; ++c) values.push_back(machine.result(k, c)[0]);
  return fmt::format("spectrum({})", fmt::join(values, ", "));
}

template <class R>
std::string text_of(const vm::Interpreter<R>& machine, const vm::Function& f,
                    const std::string& type) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < f.results.size(); ++k)
    parts.push_back(value_text(machine, f.results[k], static_cast<int>(k)));
  if (type == "complex" && parts.size() == 2)
    return fmt::format("{}{}{}i", parts[0], parts[1][0] == '-' ? "" : "+", parts[1]);
  const bool array = !type.empty() && type.back() == ']';
  if (parts.size() == 1 && !array) return parts[0];
  return fmt::format("{}{}{}", array ? "[" : type + "(", fmt::join(parts, ", "), array ? "]" : ")");
}

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

template <class R>
Exit run(const vm::Program& program, const EvalOptions& options, const std::string& expression,
         const std::vector<lang::SourcePtr>& sources) {
  const vm::Executable executable(program);
  vm::InputBatch<R> in(vm::kLaneMultiple);
  api::fill_defaults(in);
  for (const std::string& text : options.settings)
    if (const auto done = set(in, text); !done) return fail(Exit::Usage, done.error(), options);
  vm::Interpreter<R> machine(vm::kLaneMultiple);
  api::Excerpts excerpts(program, sources);
  bool printed = expression.empty();
  for (const vm::Export& e : program.exports) {
    if (!expression.empty() && e.name != kName) continue;
    printed = true;
    machine.run(executable, e.function, in, 1);
    for (const vm::Fault& fault : machine.faults()) {
      const std::string where =
          fault.line.source < program.sources.size()
              ? fmt::format("{}:{}", program.sources[fault.line.source], fault.line.line)
              : e.name;
      const bool depth = fault.cause == vm::Fault::Cause::CallDepth;
      return fail(
          Exit::Budget,
          {where, depth ? "recursion goes too deep" : "recursion does not end",
           depth ? "carry the result in an argument, so that the call is the last thing done"
                 : "check the condition that ends it"},
          options);
    }
    if (options.trace) print_trace(program, e.function, in, excerpts);
    const std::string text = text_of(machine, program.functions[e.function], e.type);
    if (expression.empty())
      fmt::print("{} = {}\n", e.name, text);
    else
      fmt::print("{}\n", text);
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
  if (expression == "-" || expression.ends_with(".mms")) {
    files.push_back(expression);
    expression.clear();
  }
  std::vector<lang::SourcePtr> sources;
  for (const std::string& file : files) {
    const auto source = api::read_source(file);
    if (!source) return fail(Exit::File, source.error(), options);
    sources.push_back(*source);
  }
  if (!expression.empty())
    sources.push_back(
        lang::make_source("<expression>", fmt::format("const {} = {};\n", kName, expression)));
  Exit exit = Exit::Ok;
  const auto linked = compile(sources, options, exit);
  if (!linked) return exit;
  return options.precision == "double" ? run<double>(linked->program, options, expression, sources)
                                       : run<float>(linked->program, options, expression, sources);
}

}  // namespace

Verb eval_verb() {
  auto options = std::make_shared<EvalOptions>();
  Verb verb{
      "eval",
      "Print the value of an expression, or of a script's constants",
      "Examples:\n  mms eval '2^0.5'\n  mms eval --set position=1,2,3 'perlin($position)'\n"
      "  mms eval --trace -O0 --set position=0,0,0 'sqrt($position.x) / $position.y'\n"
      "  mms eval -- '-1 % 3'\n  mms eval -f marble.mms 'ridged($object_position, 6, 0.5, 0.0)'",
      {},
      [options] { return eval(*options); }};
  verb.add({"EXPRESSION",
            &options->item,
            "",
            "An expression; or a script (*.mms, - is standard input) to print constants of",
            {},
            true});
  verb.add({"-f,--file", &options->files, "FILE", "A script whose names the expression may use"});
  verb.add({"--set", &options->settings, "NAME=VALUE",
            "Value of a $variable; SI units, commas between"});
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
