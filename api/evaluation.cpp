// SPDX-License-Identifier: Apache-2.0
#include "api/evaluation.h"

#include <fmt/format.h>

#include "api/inputs.h"
#include "materials/table.h"

namespace mms::api {

Evaluation::Evaluation(MMsContext& context, const MMsPoints& points)
    : context_(context), points_(points) {}

bool Evaluation::bind() {
  for (std::size_t k = 0; k < points_.input_count; ++k) {
    const MMsInput& input = points_.inputs[k];
    if (!input.name || !input.values)
      return complain({"MMsInput", "an input without name or values", ""});
    const Result<vm::Variable> variable = find_variable(input.name);
    if (!variable) return complain(variable.error());
    inputs_.push_back({*variable, input.values});
  }
  fill_defaults(context_.in);
  return true;
}

bool Evaluation::of_this_program(const LinkedProgram* owner) {
  return owner == context_.linked.get() ||
         complain({"MMsContext", "the descriptor is of another program, or of another link of it",
                   "make a context for each program, and again after it is linked"});
}

bool Evaluation::complain(const Error& why) {
  context_.messages.add(why);
  return false;
}

float Evaluation::value(const vm::ValueSource& source, int c, int i) const {
  if (source.constant) {
    const vm::Constant& constant = context_.linked->linked.program.constants[source.index];
    return constant.type == vm::SlotType::Real ? constant.f32
                                               : static_cast<float>(constant.integer);
  }
  const int k = static_cast<int>(source.index);
  if (source.type == vm::SlotType::Real) return context_.machine.result(k)[i];
  if (source.type == vm::SlotType::Spectrum) return context_.machine.result(k, c)[i];
  return static_cast<float>(context_.machine.integer_result(k)[i]);
}

void Evaluation::gather(const vm::MaterialLayout& material, int i,
                        std::vector<float>& params) const {
  params.clear();
  for (const vm::LayoutNode& node : material.nodes) {
    const materials::Formals& formals = materials::formals(static_cast<materials::Lobe>(node.lobe));
    std::size_t next = 0;
    for (int k = 0; k < formals.count; ++k) {
      if (formals.kinds[k] == 'm') continue;
      const vm::ValueSource& source = node.params[next++];
      const int size = formals.kinds[k] == 's' ? kWavelengths : 1;
      for (int c = 0; c < size; ++c) params.push_back(value(source, c, i));
    }
  }
}

void Evaluation::run_batch(std::uint32_t function, std::size_t first, int lanes) {
  for (const BoundInput& input : inputs_)
    fill(context_.in, input.variable, input.values + first, points_.count, lanes);
  context_.machine.run(context_.linked->executable, function, context_.in, lanes);
  if (const auto given_up = context_.machine.faults(); !given_up.empty()) {
    faults_ += given_up.size();
    fault_line_ = given_up[0].line;
  }
}

void Evaluation::report_faults() {
  if (faults_ == 0) return;
  const auto& sources = context_.linked->linked.program.sources;
  context_.messages.add(
      MMS_WARNING,
      fmt::format("{} points ran out of their budget; {}:{}", faults_,
                  fault_line_.source < sources.size() ? sources[fault_line_.source] : "?",
                  fault_line_.line));
}

}  // namespace mms::api
