// SPDX-License-Identifier: Apache-2.0
#include "renderer/samples.h"

#include <doctest/doctest.h>

#include <set>

#include "base/hash.h"

using namespace mms;
using namespace mms::renderer;

TEST_CASE("sets of samples are sets") {
  for (std::uint64_t round = 0; round < 200; ++round) {
    SampleSet set, other;
    std::set<std::uint32_t> truth, other_truth;
    for (std::uint64_t i = 0; i < 12; ++i) {
      const std::uint64_t h = hash_combine(round, i);
      const auto first = std::uint32_t(h % 40), last = first + std::uint32_t((h >> 32) % 7);
      const bool here = i % 3 != 0;
      (here ? set : other).add({first, last});
      for (std::uint32_t s = first; s < last; ++s) (here ? truth : other_truth).insert(s);
    }
    bool met = false;
    for (std::uint32_t s = 0; s < 50; ++s) {
      REQUIRE(set.has(s) == (truth.count(s) > 0));
      met |= truth.count(s) > 0 && other_truth.count(s) > 0;
    }
    CHECK(set.meets(other) == met);
    CHECK(set.count() == truth.size());
    for (std::uint32_t from : {0u, 5u, 20u}) {
      std::uint32_t missing = from;
      while (truth.count(missing) > 0) ++missing;
      CHECK(set.missing_from(from) == missing);
    }
    for (std::size_t i = 1; i < set.ranges().size(); ++i)
      CHECK(set.ranges()[i - 1].second < set.ranges()[i].first);
  }
}

TEST_CASE("passes follow one another, and none is in two blocks") {
  std::uint32_t next = 0;
  for (int p = 0; p < 200; ++p) {
    const auto [first, last] = pass_range(p);
    CHECK(first == next);
    CHECK(block_of(first) == block_of(last - 1));
    for (std::uint32_t s = first; s < last; ++s) CHECK(pass_of(s) == p);
    next = last;
  }
}

TEST_CASE("tiles cover the picture once") {
  const PartialFilm film(37, 50, FilterShape::Box);
  std::vector<int> covered(37 * 50);
  for (int t = 0; t < int(film.done.size()); ++t) {
    const Rect r = film.tile(t);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) ++covered[std::size_t(y * 37 + x)];
  }
  for (int c : covered) CHECK(c == 1);
}
