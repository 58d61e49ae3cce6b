// SPDX-License-Identifier: Apache-2.0
// Sample points, float against double, and the text that instructions came from.
#include "api/accuracy.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "api/excerpts.h"
#include "api/inputs.h"
#include "tests/golden/evaluate.h"

namespace mms::api {
namespace {

using golden::compile;

TEST_CASE("samples of the sphere lie on it, with a frame; those of a box in it, evenly") {
  vm::InputBatch<float> in(512);
  fill_defaults(in);
  fill_samples(in, {512, {}}, 0, 512);
  double sum[3] = {};
  for (int i = 0; i < 512; ++i) {
    double squared = 0, across = 0;
    for (int c = 0; c < 3; ++c) {
      const double p = in.lanes(vm::Variable::Position, c)[i];
      squared += p * p;
      across += p * in.lanes(vm::Variable::Tangent, c)[i];
      sum[c] += p;
    }
    CHECK(squared == doctest::Approx(1).epsilon(1e-6));
    CHECK(std::fabs(across) < 1e-6);
  }
  for (double s : sum) CHECK(std::fabs(s / 512) < 0.01);
  const auto box = parse_box("-1,2,0,1,3,10");
  REQUIRE(box);
  fill_samples(in, {512, *box}, 0, 512);
  int low = 0;
  for (int i = 0; i < 512; ++i)
    for (int c = 0; c < 3; ++c) {
      const float x = in.lanes(vm::Variable::ObjectPosition, c)[i];
      CHECK(x >= (*box)[std::size_t(c)]);
      CHECK(x <= (*box)[std::size_t(c) + 3]);
      low += c == 2 && x < 5;
    }
  CHECK(std::abs(low - 256) < 8);
  for (const char* bad :
       {"", "1,2,3", "0,0,0,1,1,1,1", "0,0,0,1,1,x", "0,0,0,1,0,1", "0,0,0,1,1,inf"})
    CHECK(!parse_box(bad));
}

TEST_CASE("accuracy finds the worst error of every output, and where it is") {
  // x + 1 - 1 loses what is below 2^-24 of 1: half an ulp of 1 at most.
  const auto c = compile(
      "surface s\n  height = ($position[0] + 1.0) - 1.0;\n  bsdf = matte(0.25 + 0.0 * "
      "$time);\nend\n"
      "surface flat height = 1.0; end\n");
  REQUIRE(c.linked);
  const Accuracy report = accuracy(c.linked->program, {1000, {}});
  REQUIRE(report.outputs.size() >= 1);
  const OutputAccuracy* height = nullptr;
  for (const OutputAccuracy& o : report.outputs) {
    CHECK(o.descriptor == "surface s");
    if (o.output == "height") height = &o;
  }
  REQUIRE(height);
  CHECK(height->compared == 1000);
  CHECK(height->worst_absolute <= 0x1p-24);
  CHECK(height->worst_absolute > 0x1p-26);
  CHECK(height->median_absolute <= height->worst_absolute);
  CHECK(height->worst_ulp > 100);  // where x is near 0
  CHECK(std::fabs(height->point[0]) < 0.01);
  CHECK(height->double_value == doctest::Approx(height->point[0]).epsilon(1e-12));
  CHECK(std::fabs(height->float_value - height->double_value) <= 0x1p-24);
  CHECK(height->not_finite == 0);
  for (const EntrySpeed& s : report.speeds) {
    CHECK(s.float_points > 0);
    CHECK(s.double_points > 0);
  }
}

TEST_CASE("what float alone loses is traced to the line that lost it") {
  const auto c = compile(
      "surface s\n  big = exp(60 + $position[0] * $position[0]);\n  height = big * big;\nend\n");
  REQUIRE(c.linked);
  const Accuracy report = accuracy(c.linked->program, {64, {}});
  const OutputAccuracy* height = nullptr;
  for (const OutputAccuracy& o : report.outputs)
    if (o.output == "height") height = &o;
  REQUIRE(height);
  CHECK(height->lost == 64);
  CHECK(height->made_at == "test.mms:3:12");
}

TEST_CASE("excerpts find lines of what was handed over and of the library") {
  const auto c =
      compile("surface s\n    height = 2.0 *   smoothstep(0.0, 1.0, $position[0]);\nend\n");
  REQUIRE(c.linked);
  Excerpts excerpts(c.linked->program, {c.source});
  const auto& sources = c.linked->program.sources;
  std::uint32_t own = 0;
  while (own < sources.size() && sources[own] != "test.mms") ++own;
  REQUIRE(own < sources.size());
  CHECK(excerpts.line({own, 2, 0}) == "height = 2.0 *   smoothstep(0.0, 1.0, $position[0]);");
  CHECK(excerpts.from_column({own, 2, 22}, 10) == "smoothstep...");
  CHECK(excerpts.line({own, 99, 0}).empty());
  bool library = false;
  for (std::uint32_t k = 0; k < sources.size(); ++k)
    library = library || (sources[k] == "<prelude>" && !excerpts.line({k, 5, 0}).empty());
  CHECK(library);
}

}  // namespace
}  // namespace mms::api
