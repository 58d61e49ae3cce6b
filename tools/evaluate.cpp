// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate.h"

#include <cmath>

#include <fmt/format.h>

#include "api/inputs.h"
#include "api/library.h"
#include "lang/parser.h"

namespace mms::tools {

namespace {

/// The value of `--set $name=text`, as numbers; widened to the variable's type.
std::optional<std::vector<double>> value_of(const VariableSetting& setting,
                                            const ScriptOptions& options, Exit& exit) {
  const vm::VariableInfo& row = vm::info(setting.variable);
  const std::string place = fmt::format("--set ${}", row.name);
  lang::Diagnostics diagnostics;
  lang::parse_expression(lang::make_source(place, setting.value), diagnostics);
  std::vector<lang::Graph> graphs;
  std::optional<lang::Linked> linked;
  if (!diagnostics.has_errors()) {
    graphs.push_back(lang::parse(
        lang::make_source(place,
                          fmt::format("const {} {} = {};\n", row.type, row.name, setting.value)),
        diagnostics));
    linked = lang::link(graphs, api::standard_library(), {}, diagnostics);
  }
  if (linked) {
    vm::InputBatch<double> in(vm::kLaneMultiple);
    api::fill_defaults(in);
    const auto value = evaluate(linked->program, linked->program.exports.at(0), in);
    if (value) return value->numbers;
    fail(Exit::Usage, value.error(), options);
  }
  print(diagnostics, options);
  exit = Exit::Usage;
  return std::nullopt;
}

template <class R>
Error fault_error(const vm::Program& program, const vm::Export& e, const vm::Fault& fault) {
  const std::string where =
      fault.line.source < program.sources.size()
          ? fmt::format("{}:{}", program.sources[fault.line.source], fault.line.line)
          : e.name;
  if (fault.cause == vm::Fault::Cause::CallDepth)
    return {where, "recursion goes too deep",
            "carry the result in an argument, so that the call is the last thing done"};
  return {where, "recursion does not end", "check the condition that ends it"};
}

/// Lane 0 of result `k`: as text, and its numbers at the end of `numbers`.
template <class R>
std::string slot_text(const vm::Interpreter<R>& machine, vm::SlotType type, int k,
                      std::vector<double>& numbers) {
  if (type == vm::SlotType::Integer || type == vm::SlotType::Logic) {
    const std::int32_t value = machine.integer_result(k)[0];
    numbers.push_back(value);
    if (type == vm::SlotType::Integer) return fmt::format("{}", value);
    return value ? "true" : "false";
  }
  std::vector<R> values;
  for (int c = 0; c < vm::block_count(type); ++c) {
    const R x = machine.result(k, c)[0];
    values.push_back(std::isnan(x) ? std::abs(x) : x);  // the sign of NaN says nothing
  }
  numbers.insert(numbers.end(), values.begin(), values.end());
  if (type == vm::SlotType::Real) return fmt::format("{}", values[0]);
  return fmt::format("spectrum({})", fmt::join(values, ", "));
}

std::string joined(const std::vector<std::string>& parts, const std::string& type) {
  if (type == "complex" && parts.size() == 2)
    return fmt::format("{}{}{}i", parts[0], parts[1][0] == '-' ? "" : "+", parts[1]);
  const bool array = !type.empty() && type.back() == ']';
  if (parts.size() == 1 && !array) return parts[0];
  return fmt::format("{}{}{}", array ? "[" : type + "(", fmt::join(parts, ", "), array ? "]" : ")");
}

}  // namespace

template <class R>
std::optional<vm::InputBatch<R>> point(const Compiled& compiled, const ScriptOptions& options,
                                       Exit& exit) {
  vm::InputBatch<R> in(vm::kLaneMultiple);
  api::fill_defaults(in);
  for (const VariableSetting& setting : compiled.variables) {
    const auto numbers = value_of(setting, options, exit);
    if (!numbers) return std::nullopt;
    const std::vector<R> values(numbers->begin(), numbers->end());
    api::fill_all<R>(in, setting.variable, values);
  }
  return in;
}

template <class R>
Result<Evaluated> evaluate(const vm::Program& program, const vm::Export& e, vm::InputBatch<R>& in) {
  const vm::Executable executable(program);
  vm::Interpreter<R> machine(in.width());
  machine.run(executable, e.function, in, 1);
  for (const vm::Fault& fault : machine.faults()) return fault_error<R>(program, e, fault);
  Evaluated value{e.type, {}, {}};
  std::vector<std::string> parts;
  const std::vector<vm::SlotType>& types = program.functions[e.function].results;
  for (std::size_t k = 0; k < types.size(); ++k)
    parts.push_back(slot_text(machine, types[k], static_cast<int>(k), value.numbers));
  value.text = joined(parts, e.type);
  return value;
}

template std::optional<vm::InputBatch<float>> point(const Compiled&, const ScriptOptions&, Exit&);
template std::optional<vm::InputBatch<double>> point(const Compiled&, const ScriptOptions&, Exit&);
template Result<Evaluated> evaluate(const vm::Program&, const vm::Export&, vm::InputBatch<float>&);
template Result<Evaluated> evaluate(const vm::Program&, const vm::Export&, vm::InputBatch<double>&);

}  // namespace mms::tools
