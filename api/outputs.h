// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The outputs of descriptors by the names that scripts use, and where their numbers are.

#include <optional>
#include <string_view>
#include <vector>

#include "vm/interpreter.h"
#include "vm/program.h"

namespace mms::api {

/// The entries of a descriptor by name.
struct NamedEntry {
  const char* name;
  const vm::Entry vm::Descriptor::*entry;
};
inline constexpr NamedEntry kEntries[] = {{"shade", &vm::Descriptor::shade},
                                          {"pass", &vm::Descriptor::pass},
                                          {"emit", &vm::Descriptor::emit},
                                          {"displace", &vm::Descriptor::displace}};

/// `bsdf` or `phase`, `scattering`, ...; empty where that form has no such output.
std::string_view output_name(vm::DescriptorForm form, vm::Output output);

/// The output that a descriptor of that form calls `name`.
std::optional<vm::Output> find_output(vm::DescriptorForm form, std::string_view name);

/// An output made of numbers: the entry to run, and where each of its values is afterwards.
struct NumberSources {
  const vm::Entry* entry;
  std::vector<vm::ValueSource> sources;
};

/// Empty for the two outputs that are materials. Borrows the descriptor.
std::optional<NumberSources> number_sources(const vm::Descriptor& descriptor, vm::Output output);

/// The material of an output, and the entry that computes its numbers; null for other outputs.
struct MaterialSource {
  const vm::Entry* entry;
  const vm::MaterialLayout* layout;
};
std::optional<MaterialSource> material_source(const vm::Descriptor& descriptor, vm::Output output);

/// The numbers of a material at the first point of `in`, as materials/layout.h lays them out.
std::vector<double> material_numbers(const vm::Program& program, const MaterialSource& source,
                                     vm::InputBatch<double>& in);

/// The name of a scattering model or combiner as scripts write it.
std::string_view lobe_name(int lobe);

}  // namespace mms::api
