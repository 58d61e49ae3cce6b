// SPDX-License-Identifier: Apache-2.0
#include "renderer/switches.h"

namespace mms::renderer {
namespace {

constexpr SwitchInfo kEstimators[] = {
    {"clustered", "each wavelength by how likely all eight were to choose this path: (4.7)"},
    {"unweighted",
     "all eight over the density of the hero alone: (4.5); unfit for polished glass that "
     "disperses"},
    {"single", "the hero alone: (4.4)"},
    {"four", "as clustered, with four wavelengths: more colour noise (Figure 4.8)"},
};

constexpr SwitchInfo kGenerators[] = {
    {"niederreiter", "a (1, 4)-sequence of Niederreiter and Xing, Owen-scrambled for each pixel"},
    {"sobol", "Sobol's sequence, Owen-scrambled for each pixel"},
    {"random", "hashed numbers: plain Monte Carlo"},
    {"unscrambled", "the (1, 4)-sequence as it is, the same for every pixel: patterns show"},
};

template <class Switch>
std::optional<Switch> named(std::span<const SwitchInfo> all, std::string_view name) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name) return Switch(i);
  return std::nullopt;
}

}  // namespace

std::span<const SwitchInfo> estimators() { return kEstimators; }
std::span<const SwitchInfo> generators() { return kGenerators; }

std::optional<Estimator> estimator_named(std::string_view name) {
  return named<Estimator>(kEstimators, name);
}

std::optional<Generator> generator_named(std::string_view name) {
  return named<Generator>(kGenerators, name);
}

}  // namespace mms::renderer
