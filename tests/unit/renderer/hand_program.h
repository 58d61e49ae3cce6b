// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Programs without scripts: descriptors of constants, made by hand, so that the renderer is tested
/// without the compiler.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "materials/table.h"
#include "renderer/render.h"
#include "vm/program.h"

namespace mms::renderer::test {

using materials::Lobe;

struct HandProgram {
  vm::Program program;

  HandProgram() { program.descriptors.reserve(16); }  // references stay valid

  vm::ValueSource real(double v) { return constant(v, vm::SlotType::Real); }
  vm::ValueSource spectrum(double v) { return constant(v, vm::SlotType::Spectrum); }
  static vm::MaterialLayout lobe(Lobe l, std::vector<vm::ValueSource> params) {
    return {{{int(l), std::move(params), {}}}};
  }

  vm::Descriptor& surface(const std::string& name, vm::MaterialLayout bsdf) {
    vm::Descriptor& d = program.descriptors.emplace_back();
    d.name = name;
    for (vm::Entry* e : entries(d)) {
      e->scattering = spectrum(1);
      e->absorption = spectrum(0);
      e->emission = spectrum(0);
      e->height = e->bound = e->gradient[0] = e->gradient[1] = real(0);
      e->material = bsdf;
      e->emission_material = lobe(Lobe::Matte, {spectrum(1)});
    }
    return d;
  }
  vm::Descriptor& matte(const std::string& name, double albedo) {
    return surface(name, lobe(Lobe::Matte, {spectrum(albedo)}));
  }
  vm::Descriptor& volume(const std::string& name, double scattering, double absorption) {
    vm::Descriptor& d = surface(name, lobe(Lobe::Isotropic, {}));
    d.form = vm::DescriptorForm::Volume;
    for (vm::Entry* e : entries(d)) {
      e->scattering = spectrum(scattering);
      e->absorption = spectrum(absorption);
      e->emission_material = lobe(Lobe::Isotropic, {});
    }
    return d;
  }
  static std::vector<vm::Entry*> entries(vm::Descriptor& d) {
    return {&d.shade, &d.pass, &d.emit, &d.displace};
  }

 private:
  vm::ValueSource constant(double v, vm::SlotType type) {
    program.constants.push_back({vm::SlotType::Real, float(v), v, 0});
    return {type, true, std::uint32_t(program.constants.size() - 1)};
  }
};

/// Mean luminance of a picture and the standard error of it, from the variance of the samples.
struct Mean {
  double value = 0, error = 0;
};
inline Mean mean_luminance(const Film& film) {
  Mean m;
  double variance = 0;
  for (std::size_t i = 0; i < film.xyz.size(); ++i) {
    m.value += film.xyz[i][1];
    variance += film.variance[i];
  }
  const double n = double(film.xyz.size());
  return {m.value / n, std::sqrt(variance) / n};
}

}  // namespace mms::renderer::test
