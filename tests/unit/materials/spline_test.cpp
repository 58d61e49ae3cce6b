// SPDX-License-Identifier: Apache-2.0
// Sums of many numbers from a table.
#include "materials/spline.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/stats/random.h"

using namespace mms;
using materials::Stencil;

TEST_CASE_TEMPLATE("numbers of a table are those of a plain loop to the bit, however many", R,
                   float, double) {
  constexpr int kNodes = 5, kAcross = materials::coefficients(kNodes);
  stats::Random random(1);
  for (int terms = 1; terms <= 90; ++terms) {
    std::vector<float> table(kAcross * kAcross * terms);
    for (float& x : table) x = random.next_float() - 0.5f;
    const auto a = Stencil<R>::at(R(random.next()), kNodes),
               b = Stencil<R>::at(R(random.next()), kNodes);
    const R weight = R(random.next());
    std::vector<R> sums(terms + 1, R(0.75)), expected = sums;
    materials::add_terms(sums.data(), terms, table.data(), weight, a, kAcross * terms, b, terms);
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k)
        for (int t = 0; t < terms; ++t)
          expected[t] += weight * a.weight[i] * b.weight[k] *
                         R(table[((a.first + i) * kAcross + b.first + k) * terms + t]);
    CHECK_MESSAGE(sums == expected, terms);
  }
}
