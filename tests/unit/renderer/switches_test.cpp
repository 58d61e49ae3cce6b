// SPDX-License-Identifier: Apache-2.0
// Ways to do the same work have the same mean, and the errors that they are there to compare.
#include "renderer/switches.h"

#include <doctest/doctest.h>

#include <cmath>

#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// Frosted glass that disperses, in front of a graded world: every lobe depends on wavelength.
const char* const kFrosted =
    "surface s\n bsdf = dielectric(1.4 + 20e-15 / ($wavelength * $wavelength), 0.3);\nend\n"
    "volume s\n scattering = 0.3 * rgb(0.2, 0.5, 1); absorption = 0.1 * rgb(1, 0.5, 0.2);\nend\n";
const char* const kScene = R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 20},
  "environment": {"constant": 0.3}, "materials": {"lamp": {"matte": 0, "emission": [6, 4, 2]}},
  "objects": [{"sphere": {}, "test": true},
    {"disc": {"center": [3, 3, 3], "normal": [-1, -1, -1], "radius": 1.5}, "surface": "lamp"},
    {"disc": {"center": [-2, 0, -4], "normal": [2, 0, 4], "radius": 2}, "surface": "lamp"}]})";

Mean rendered(const vm::Program& p, Estimator e, Generator g, int samples) {
  RenderOptions o = options(16, samples);
  o.estimator = e;
  o.generator = g;
  return mean_luminance(run(p, scene_of(p, kScene), o).film);
}

}  // namespace

TEST_CASE("names of switches are read back, and nothing else is") {
  for (int e = 0; e < int(estimators().size()); ++e)
    CHECK(estimator_named(estimators()[std::size_t(e)].name) == Estimator(e));
  CHECK_FALSE(estimator_named("best").has_value());
  CHECK_FALSE(generator_named("").has_value());
}

TEST_CASE("estimators have one mean; clustered is of less error than unweighted and single") {
  const vm::Program p = compile(kFrosted);
  const int n = kSanitized ? 32 : 256;
  const Mean clustered = rendered(p, Estimator::Clustered, Generator::Random, n);
  const Mean unweighted = rendered(p, Estimator::Unweighted, Generator::Random, n);
  const Mean single = rendered(p, Estimator::SingleSample, Generator::Random, n);
  const Mean four = rendered(p, Estimator::Four, Generator::Random, n);
  CHECK(std::abs(clustered.value - four.value) < 4 * std::hypot(clustered.error, four.error));
  INFO(clustered.value, " +- ", clustered.error, ", ", unweighted.value, " +- ", unweighted.error,
       ", ", single.value, " +- ", single.error);
  CHECK(std::abs(clustered.value - unweighted.value) <
        4 * std::hypot(clustered.error, unweighted.error));
  CHECK(std::abs(clustered.value - single.value) < 4 * std::hypot(clustered.error, single.error));
  // Luminance of one wavelength varies by more than a half of its mean; eight share that.
  CHECK(1.4 * clustered.error < single.error);
  CHECK(clustered.error < unweighted.error);
}

TEST_CASE("generators have one mean") {
  const vm::Program p = compile(kFrosted);
  const int n = kSanitized ? 32 : 256;
  const Mean random = rendered(p, Estimator::Clustered, Generator::Random, n);
  // Stated errors take samples for independent ones, or pixels: the sequences' are smaller, but
  // for the unscrambled one's, which all pixels share, so that its error does not average out.
  for (const Generator g : {Generator::Niederreiter, Generator::Sobol}) {
    const Mean m = rendered(p, Estimator::Clustered, g, n);
    CHECK(std::abs(m.value - random.value) < 4 * std::hypot(m.error, random.error));
  }
  const Mean plain = rendered(p, Estimator::Clustered, Generator::Unscrambled, n);
  CHECK(std::abs(plain.value - random.value) < 0.05 * random.value);
}
