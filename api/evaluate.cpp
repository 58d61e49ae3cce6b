// SPDX-License-Identifier: Apache-2.0
// Evaluation over arrays of points: contexts, and outputs and values that are made of numbers.
#include <fmt/format.h>

#include "api/evaluation.h"
#include "api/outputs.h"

using namespace mms;

namespace {

/// Writes every value of `sources`, component after component, for every point.
bool write(api::Evaluation& evaluation, const std::optional<std::uint32_t>& function,
           const std::vector<vm::ValueSource>& sources, float* values) {
  return evaluation.run(function, [&](std::size_t first, int lanes) {
    float* out = values + first;
    for (const vm::ValueSource& source : sources)
      for (int c = 0; c < vm::block_count(source.type); ++c, out += evaluation.count())
        for (int i = 0; i < lanes; ++i) out[i] = evaluation.value(source, c, i);
  });
}

template <class Handle>
int eval_output(MMsContext* context, const Handle* handle, const char* name,
                const MMsPoints* points, float* values) {
  if (!context || !handle || !name || !points || !values) return 0;
  return api::guarded(context->messages, [&] {
    api::Evaluation evaluation(*context, *points);
    if (!evaluation.of_this_program(handle->owner)) return false;
    const vm::Descriptor& descriptor = *handle->descriptor;
    const auto output = api::find_output(descriptor.form, name);
    if (!output) return evaluation.complain({name, "there is no output of that name", ""});
    const auto numbers = api::number_sources(descriptor, *output);
    if (!numbers)
      return evaluation.complain(
          {name, "is a material, not numbers", "mms.h has functions for what it scatters"});
    return evaluation.bind() &&
           write(evaluation, numbers->entry->function, numbers->sources, values);
  });
}

const vm::Export* find_value(const vm::Program& program, const char* name) {
  for (const vm::Export& e : program.exports)
    if (e.name == name) return &e;
  return nullptr;
}

}  // namespace

MMsContext* mmsMkContext(const MMsProgram* program) {
  return program && program->linked ? api::make<MMsContext>(program->linked) : nullptr;
}

void mmsDeleteContext(MMsContext* context) { delete context; }

const char* mmsGetContextLog(const MMsContext* context) {
  return context ? context->messages.text.c_str() : "";
}

int mmsEvalSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                   const MMsPoints* points, float* values) {
  return eval_output(context, surface, output, points, values);
}

int mmsEvalVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                  const MMsPoints* points, float* values) {
  return eval_output(context, volume, output, points, values);
}

int mmsEvalValue(MMsContext* context, const char* name, const MMsPoints* points, float* values) {
  if (!context || !name || !points || !values) return 0;
  return api::guarded(context->messages, [&] {
    api::Evaluation evaluation(*context, *points);
    const vm::Program& program = context->linked->linked.program;
    const vm::Export* e = find_value(program, name);
    if (!e)
      return evaluation.complain({name, "is no constant and no function without arguments",
                                  "mmsGetValue lists what there is"});
    std::vector<vm::ValueSource> sources;
    for (const vm::SlotType type : program.functions[e->function].results)
      sources.push_back({type, false, static_cast<std::uint32_t>(sources.size())});
    return evaluation.bind() && write(evaluation, e->function, sources, values);
  });
}
