// SPDX-License-Identifier: Apache-2.0
#include "api/outputs.h"

#include "materials/table.h"
#include "vm/outputs.h"

namespace mms::api {

std::string_view output_name(vm::DescriptorForm form, vm::Output output) {
  return vm::output_name(form, output);
}

std::optional<vm::Output> find_output(vm::DescriptorForm form, std::string_view name) {
  if (name.empty()) return std::nullopt;
  for (std::size_t o = 0; o < vm::kOutputCount; ++o)
    if (vm::output_name(form, vm::Output(o)) == name) return vm::Output(o);
  return std::nullopt;
}

std::optional<NumberSources> number_sources(const vm::Descriptor& d, vm::Output output) {
  switch (output) {
    case vm::Output::Scattering:
      return NumberSources{&d.pass, {d.pass.scattering}};
    case vm::Output::Absorption:
      return NumberSources{&d.pass, {d.pass.absorption}};
    case vm::Output::Emission:
      return NumberSources{&d.emit, {d.emit.emission}};
    case vm::Output::Height:
      return NumberSources{&d.displace, {d.displace.height}};
    case vm::Output::Bound:
      return NumberSources{&d.displace, {d.displace.bound}};
    case vm::Output::Gradient:
      return NumberSources{&d.shade, {d.shade.gradient[0], d.shade.gradient[1]}};
    default:
      return std::nullopt;
  }
}

std::optional<MaterialSource> material_source(const vm::Descriptor& d, vm::Output output) {
  if (output == vm::Output::Material) return MaterialSource{&d.shade, &d.shade.material};
  if (output == vm::Output::EmissionMaterial)
    return MaterialSource{&d.emit, &d.emit.emission_material};
  return std::nullopt;
}

std::vector<double> material_numbers(const vm::Program& program, const MaterialSource& source,
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

std::string_view lobe_name(int lobe) {
  for (const vm::Builtin& row : materials::rows()) {
    if (row.lobe != lobe) continue;
    const std::size_t space = row.signature.find(' ');
    return row.signature.substr(space + 1, row.signature.find('(') - space - 1);
  }
  return "?";
}

}  // namespace mms::api
