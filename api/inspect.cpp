// SPDX-License-Identifier: Apache-2.0
// What a linked program knows about itself: params, descriptors, values, imports.
#include <algorithm>

#include "api/handles.h"
#include "api/inputs.h"
#include "api/outputs.h"
#include "vm/outputs.h"

using namespace mms;

namespace {

/// Row `index` of `rows` of the linked program, or null past the end and before a link.
template <class Row>
const Row* row(const MMsProgram* program, std::vector<Row> lang::Linked::*rows, std::size_t index) {
  if (!program || !program->linked) return nullptr;
  const std::vector<Row>& all = program->linked->linked.*rows;
  return index < all.size() ? &all[index] : nullptr;
}

template <class Handle>
const char* name_at(const MMsProgram* program, std::deque<Handle> api::LinkedProgram::*handles,
                    std::size_t index) {
  if (!program || !program->linked) return nullptr;
  const std::deque<Handle>& all = (*program->linked).*handles;
  return index < all.size() ? all[index].descriptor->name.c_str() : nullptr;
}

/// Hidden variables are made of a public one: the wavelength, or what they are the change of.
std::uint32_t public_variables(std::uint32_t bits) {
  std::uint32_t out = 0;
  for (const vm::VariableInfo& v : vm::kVariables) {
    if (!(bits >> static_cast<unsigned>(v.variable) & 1u)) continue;
    vm::Variable shown = v.variable;
    if (v.slot_type() == vm::SlotType::Spectrum) shown = vm::Variable::Wavelength;
    out |= 1u << static_cast<unsigned>(shown);
  }
  return out;
}

template <class Handle>
int output_info(const Handle* handle, const char* name, MMsOutputInfo* info) {
  if (!handle || !name || !info) return 0;
  const auto output = api::find_output(handle->descriptor->form, name);
  if (!output) return 0;
  const vm::OutputInfo& known = handle->descriptor->output(*output);
  *info = {known.stated, known.constant, known.spectral, public_variables(known.variables)};
  return 1;
}

}  // namespace

const char* mmsGetVersion(void) { return MMS_VERSION; }

int mmsGetParam(const MMsProgram* program, size_t index, MMsParamInfo* info) {
  const lang::ParamInfo* p = row(program, &lang::Linked::params, index);
  if (!p || !info) return 0;
  const auto range = p->range.value_or(std::pair(0.0, 0.0));
  *info = {p->name.c_str(),  p->type.c_str(), p->label.c_str(), p->unit.c_str(),
           p->page.c_str(),  p->doc.c_str(),  p->value.size(),  p->value.data(),
           p->range ? 1 : 0, range.first,     range.second};
  return 1;
}

const char* mmsGetSurfaceName(const MMsProgram* program, size_t index) {
  return name_at(program, &api::LinkedProgram::surfaces, index);
}

const char* mmsGetVolumeName(const MMsProgram* program, size_t index) {
  return name_at(program, &api::LinkedProgram::volumes, index);
}

const char* mmsGetImport(const MMsProgram* program, size_t index) {
  const std::string* name = row(program, &lang::Linked::dependencies, index);
  return name ? name->c_str() : nullptr;
}

int mmsGetSurfaceOutput(const MMsSurface* surface, const char* output, MMsOutputInfo* info) {
  return output_info(surface, output, info);
}

int mmsGetVolumeOutput(const MMsVolume* volume, const char* output, MMsOutputInfo* info) {
  return output_info(volume, output, info);
}

const char* mmsGetVariableName(size_t index) {
  return index < vm::kVariables.size() ? vm::kVariables[index].name.data() : nullptr;
}

size_t mmsGetVariableSize(const char* name) {
  if (!name) return 0;
  for (const vm::VariableInfo& v : vm::kVariables)
    if (v.name == name && api::may_be_set(v.variable))
      return static_cast<size_t>(api::value_count(v.variable));
  return 0;
}

int mmsGetValue(const MMsProgram* program, size_t index, MMsValueInfo* info) {
  if (!program || !program->linked || !info) return 0;
  const vm::Program& p = program->linked->linked.program;
  if (index >= p.exports.size()) return 0;
  const vm::Export& e = p.exports[index];
  size_t size = 0;
  for (const vm::SlotType type : p.functions[e.function].results)
    size += static_cast<size_t>(vm::block_count(type));
  *info = {e.name.c_str(), e.type.c_str(), size};
  return 1;
}

size_t mmsGetOutputSize(const char* output) {
  if (!output) return 0;
  for (const vm::OutputRow& r : vm::kOutputs) {
    if (r.surface != output && r.volume != output) continue;
    switch (r.shape) {
      case vm::OutputRow::Shape::Material:
        return 0;
      case vm::OutputRow::Shape::Spectrum:
        return kWavelengths;
      case vm::OutputRow::Shape::Real:
        return 1;
      case vm::OutputRow::Shape::Real2:
        return 2;
    }
  }
  return 0;
}
