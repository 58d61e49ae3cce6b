// SPDX-License-Identifier: Apache-2.0
// Which output of a script is not finite, and what the script was told there.
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "renderer/scripts.h"
#include "vm/outputs.h"
#include "vm/variables.h"

namespace mms::renderer {
namespace {

struct Watched {
  vm::Output output;
  const vm::ValueSource* value;
};

/// What an entry says, number by number.
std::vector<Watched> watched(const vm::Entry& e) {
  std::vector<Watched> all;
  const auto add = [&](vm::Output output, const vm::ValueSource& v) {
    all.push_back({output, &v});
  };
  for (const vm::LayoutNode& node : e.material.nodes)
    for (const vm::ValueSource& v : node.params) add(vm::Output::Material, v);
  add(vm::Output::Scattering, e.scattering);
  add(vm::Output::Absorption, e.absorption);
  for (const vm::LayoutNode& node : e.emission_material.nodes)
    for (const vm::ValueSource& v : node.params) add(vm::Output::EmissionMaterial, v);
  add(vm::Output::Emission, e.emission);
  for (const vm::ValueSource& v : e.gradient) add(vm::Output::Gradient, v);
  return all;
}

}  // namespace

void Scripts::inspect(const vm::Descriptor& d, const vm::Entry& entry, int lanes) {
  if (not_finite_.contains(&d)) return;
  for (const Watched& w : watched(entry))
    for (int lane = 0; lane < lanes; ++lane) {
      if (given_up(lane)) continue;
      const Spectrumf s = spectrum(*w.value, lane);
      for (int k = 0; k < kWavelengths; ++k)
        if (!std::isfinite(s[k])) {
          not_finite_[&d] = {d.name, std::string(vm::output_name(d.form, w.output)),
                             w.value->constant ? "" : settings(d, lane, k)};
          return;
        }
    }
}

/// The variables that the descriptor reads, as they were in the last run.
std::string Scripts::settings(const vm::Descriptor& d, int lane, int wavelength) const {
  std::string text;
  for (const vm::VariableInfo& v : vm::kVariables) {
    if (v.visibility != vm::Visibility::Public) continue;
    if (!(compiled_->of(&d).all_variables >> int(v.variable) & 1)) continue;
    const auto number = [&](int c) { return inputs_->lanes(v.variable, c)[lane]; };
    if (v.variable == vm::Variable::Wavelength)
      text += fmt::format(" --set {}={:.7g}nm", v.name, 1e9 * double(number(wavelength)));
    else if (v.components() == 1)
      text += fmt::format(" --set {}={:.9g}", v.name, number(0));
    else if (v.components() == 2)
      text += fmt::format(" --set {}=[{:.9g},{:.9g}]", v.name, number(0), number(1));
    else if (v.components() == 3)
      text +=
          fmt::format(" --set {}=[{:.9g},{:.9g},{:.9g}]", v.name, number(0), number(1), number(2));
  }
  return text.empty() ? text : text.substr(1);
}

}  // namespace mms::renderer
