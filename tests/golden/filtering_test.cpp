// SPDX-License-Identifier: Apache-2.0
// What filtered patterns of the library promise: the value for a width is the mean of the sharp
// pattern over a box as wide. The oracle is the sharp pattern itself, summed over a fine lattice.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"

namespace mms::golden {
namespace {

/// The values of `real value()` in a script at points of `$position`, by the double machine.
class Pattern {
 public:
  explicit Pattern(const std::string& expression) : compiled_(compile(script(expression))) {
    REQUIRE_MESSAGE(compiled_.linked, expression, "\n", compiled_.text_of_errors());
    executable_.emplace(compiled_.linked->program);
  }

  std::vector<double> at(const std::vector<std::array<double, 3>>& points) const {
    std::vector<double> all;
    constexpr int kBatch = 64;
    vm::InputBatch<double> in(kBatch);
    api::fill_defaults(in);
    for (std::size_t first = 0; first < points.size(); first += kBatch) {
      const int lanes = static_cast<int>(std::min<std::size_t>(kBatch, points.size() - first));
      for (int i = 0; i < lanes; ++i)
        for (int c = 0; c < 3; ++c)
          in.lanes(vm::Variable::Position, c)[i] = points[first + std::size_t(i)][std::size_t(c)];
      const vm::Program& program = compiled_.linked->program;
      const Run r = run(program, *executable_, program.exports[0].function, in, lanes);
      all.insert(all.end(), r.values[0].begin(), r.values[0].end());
    }
    return all;
  }

 private:
  static std::string script(const std::string& expression) {
    return "real value() = " + expression + ";\n";
  }
  Compiled compiled_;
  std::optional<vm::Executable> executable_;
};

/// `expression` with `width` in place of each W.
std::string with_width(std::string expression, double width) {
  for (std::size_t at; (at = expression.find('W')) != std::string::npos;)
    expression.replace(at, 1, fmt::format("{:.6f}", width));
  return expression;
}

using Points = std::vector<std::array<double, 3>>;

/// Some points of a square of 8 by 8 units around the origin.
Points some_points(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-4, 4);
  Points all;
  for (int i = 0; i < count; ++i) all.push_back({number(random), number(random), number(random)});
  return all;
}

/// The mean over a box around `p`, by `across` x `along` midpoints.
double mean_around(const Pattern& sharp, const std::array<double, 3>& p, double width, int across,
                   int along) {
  Points all;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < along; ++k)
      all.push_back({p[0] + width * ((i + 0.5) / across - 0.5),
                     p[1] + width * ((k + 0.5) / along - 0.5), p[2]});
  double sum = 0;
  for (double v : sharp.at(all)) sum += v;
  return sum / double(all.size());
}

/// The largest difference between filtered values and means of sharp ones.
double worst(const std::string& expression, double width, int points, int across, int along) {
  const Pattern sharp(with_width(expression, 0)), filtered(with_width(expression, width));
  const Points at = some_points(points);
  const std::vector<double> found = filtered.at(at);
  double most = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    most = std::max(most, std::abs(found[i] - mean_around(sharp, at[i], width, across, along)));
  return most;
}

constexpr double kWidths[] = {0.0007, 0.05, 0.3, 1.0, 2.7};

/// Of n midpoints those next to an edge are wrong by up to one half; between edges the patterns
/// are straight lines, for which the rule is exact, or arcs, where it errs by less. There are two
/// edges a unit.
double lattice_error(double width, int n) { return (2 * width + 2) * 0.5 / n; }

TEST_CASE("along a line the filter is exact") {
  for (const char* expression :
       {"alternating($position.x, W)", "stripes($position.x, 0.3, W)", "saw($position.x, W)",
        "triangle($position.x, W)", "step(0.4, $position.x, W)", "pulse(-0.6, 0.7, $position.x, W)",
        "linearstep(-0.6, 0.7, $position.x, W)", "linearstep(0.3, 0.3, $position.x, W)",
        "rings([$position.x + 9, 0, 0], 0.0, [W, W, W])",
        "gradient_linear([$position.x, 2], [-1, 1], [2, 1], [W, 0])"})
    for (const double width : kWidths) {
      CAPTURE(expression);
      CAPTURE(width);
      constexpr int kAcross = kSanitized ? 500 : 4000;
      // `alternating` jumps by 2.
      CHECK(worst(expression, width, 20, kAcross, 1) <= 2 * lattice_error(width, kAcross) + 1e-9);
    }
}

TEST_CASE("patterns made of lines along the axes are filtered exactly") {
  for (const char* expression : {"checker([$position.x, $position.y], [W, W])",
                                 "grid([$position.x, $position.y], 0.2, [W, W])",
                                 "brick([$position.x, $position.y], 0.15, [W, W])",
                                 "tile([$position.x, $position.y], 0.1, 0.2, [W, W])",
                                 "weave([$position.x, $position.y], 0.7, [W, W])[0]",
                                 "weave([$position.x, $position.y], 0.7, [W, W])[1]"})
    for (const double width : kWidths) {
      CAPTURE(expression);
      CAPTURE(width);
      constexpr int kAlong = kSanitized ? 30 : 100;
      CHECK(worst(expression, width, 20, kAlong, kAlong) <= 2 * lattice_error(width, kAlong));
    }
}

/// Shapes with slanting edges: the filter is a box across the edge instead of one along the axes,
/// and curves and corners are taken for straight.
struct Shape {
  std::string expression;
  double near;   ///< how far a small width is off
  double share;  ///< how far the share of a wide one is off
};

TEST_CASE("patterns with edges of any direction are filtered nearly") {
  for (const Shape& shape : {
           Shape{"dots([$position.x, $position.y], 0.3, [W, W])", 0.12, 0.002},
           Shape{"hexagon([$position.x, $position.y], 0.2, [W, W])", 0.12, 0.002},
           Shape{"cracks([$position.x, $position.y], 0.1, [W, W])", 0.2, 0.02},
           Shape{"spiral([$position.x, $position.y], 2, 0.4, [W, W])", 0.2, 0.02},
           Shape{"scratches([$position.x, $position.y], 3, 0.1, 2.0, 0.2, [W, W])", 0.2, 0.02},
       }) {
    constexpr int kAcross = 1200;
    CAPTURE(shape.expression);
    CHECK(worst(shape.expression, 0.1, 60, 50, 50) <= shape.near);
    const Pattern sharp(with_width(shape.expression, 0)), wide(with_width(shape.expression, 1));
    // A lattice that no multiple of a unit meets twice.
    const double share = mean_around(sharp, {0, 0, 0}, 161.803, kAcross, kAcross);
    double sum = 0;
    for (const double v : wide.at(some_points(400))) sum += v / 400;
    CHECK(std::abs(sum - share) <= shape.share);
  }
}

}  // namespace
}  // namespace mms::golden
