// SPDX-License-Identifier: Apache-2.0
// Enclosures of cellular noise: every result lies in its own, and they are as wide as the box.
#include <doctest/doctest.h>

#include "tests/sanitized.h"
#include "tests/unit/stdlib/worley.h"
#include "vm/interval.h"

namespace mms::stdlib::testing {
namespace {

using vm::Interval;

/// A box of places whose ends are floats, the other arguments of a setting behind them.
std::vector<Interval> random_box(std::mt19937& random, const Setting& s, bool exponent) {
  std::uniform_real_distribution<float> place(-20, 20), unit(0, 1);
  const float size = std::exp2(-12 + 12 * unit(random));
  std::vector<Interval> in;
  for (int k = 0; k < s.n; ++k) {
    const float lo = place(random), hi = lo + size * (random() % 4 ? unit(random) : 0);
    in.push_back({lo, hi, false});
  }
  in.push_back(Interval::point(s.seed));
  for (int k = 0; k < s.n; ++k) in.push_back(Interval::point(s.period));
  in.push_back(Interval::point(s.jitter));
  if (exponent) in.push_back(Interval::point(s.exponent));
  return in;
}

/// Results of a row at places of the box that are not in `out`.
template <class R>
int outside(std::mt19937& random, const vm::Builtin& row, const Setting& s,
            const std::vector<Interval>& box, const std::vector<Interval>& out, bool exponent) {
  constexpr int kPlaces = 32;
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Column<R>> p(std::size_t(s.n), Column<R>(kPlaces));
  for (std::size_t k = 0; k < p.size(); ++k)
    for (int i = 0; i < kPlaces; ++i) {
      const double t = i < 2 ? i : unit(random);
      p[k][std::size_t(i)] =
          std::clamp(R(std::lerp(box[k].lo, box[k].hi, t)), R(box[k].lo), R(box[k].hi));
    }
  const auto found = run<R>(row, arguments(p, s, exponent));
  int count = 0;
  for (std::size_t j = 0; j < out.size(); ++j)
    for (const R value : found[j]) count += !out[j].contains(double(value));
  return count;
}

TEST_CASE("worley: every distance lies in its enclosure, which is as wide as the box is long") {
  std::mt19937 random(12);
  struct Kind {
    const char* name;
    const vm::Builtin& (*row)(int);
    int results;
    bool exponent;
  };
  for (const Kind& kind : {Kind{"nearest", nearest_row, 3, true},
                           Kind{"squared", squares_row, 3, true}, Kind{"edge", edge_row, 1, false}})
    for (int n = 1; n <= 4; ++n)
      for (const Setting s :
           {Setting{n}, Setting{n, 1, 4}, Setting{n, 3.5, -1}, Setting{n, 1e3, 9},
            Setting{n, 2, 5, 3, 0.625}, Setting{n, 1.25, 5, 4, -0.875}, Setting{n, 2, 1, 0, 0}}) {
        if (!kind.exponent && s.exponent != 2) continue;
        CAPTURE(kind.name);
        CAPTURE(n);
        CAPTURE(s.exponent);
        CAPTURE(s.jitter);
        const vm::Builtin& row = kind.row(n);
        int beyond = 0, close = 0, boxes = 0;
        for (int b = 0; b < (kSanitized ? 5 : 60); ++b) {
          const auto box = random_box(random, s, kind.exponent);
          std::vector<Interval> out(std::size_t(kind.results),
                                    Interval{row.bounds.low, row.bounds.high, true});
          row.bounds.run(box.data(), out.data());
          beyond += outside<float>(random, row, s, box, out, kind.exponent) +
                    outside<double>(random, row, s, box, out, kind.exponent);
          Vector edges;
          for (int k = 0; k < n; ++k) edges.push_back(box[std::size_t(k)].width());
          const double length = distance(edges, s.exponent);
          if (length > 0.1) continue;
          for (const Interval& r : out) {
            ++boxes;
            // A square changes 2 F times as fast as F.
            const double steep =
                row.bounds.run == squares_row(n).bounds.run ? 2 * std::sqrt(r.hi) : 1;
            close += r.width() <= steep * (length + 0x1p-16);
          }
        }
        CHECK(beyond == 0);
        // Squares are known where they are those of the metric; edges where the neighbour is near.
        if (row.bounds.run == squares_row(n).bounds.run && s.exponent != 2) continue;
        CHECK(close >= 0.9 * boxes);
      }
}

TEST_CASE("worley: what is not known of the arguments leaves the range") {
  for (int n = 1; n <= 4; ++n) {
    const Setting s{n};
    std::mt19937 random(2);
    for (const int unknown : {n, n + 1, 2 * n + 1, 2 * n + 2}) {
      auto box = random_box(random, s, true);
      box[std::size_t(unknown)] = {0.5, 1, false};
      Interval out[3] = {};
      nearest_row(n).bounds.run(box.data(), out);
      for (const Interval& r : out) {
        CHECK(r.lo == 0);
        CHECK(r.hi <= n + 1 + 0x1p-16);
        CHECK(!r.nan);
      }
    }
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
