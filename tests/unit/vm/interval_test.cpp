// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic against brute force: results of float and double arithmetic at points of the
// operands.
#include "vm/interval.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/sanitized.h"

namespace mms::vm {
namespace {

constexpr double kInf = Interval::kInf;
const float kNan = std::nanf("");

std::vector<float> ends() {
  return {0.0f, 1e-45f, 1e-38f,      0.3f, 1.0f,          1.0000001f,
          2.5f, 7.0f,   16777216.0f, 3e9f, 3.4028235e38f, INFINITY};
}

class Random {
 public:
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  float number() {
    static const std::vector<float> all = ends();
    const float x = below(2) ? all[static_cast<std::size_t>(below(int(all.size())))]
                             : std::uniform_real_distribution<float>(0, 10)(engine_);
    return below(2) ? x : -x;
  }
  Interval interval() {
    const float a = number(), b = below(3) ? number() : a;
    return {std::min(a, b), std::max(a, b), below(8) == 0};
  }
  template <class R>
  R inside(const Interval& i) {
    if (i.nan && below(3) == 0) return R(kNan);
    const int how = below(4);
    if (how == 0) return R(i.lo);
    if (how == 1) return R(i.hi);
    if (how == 2 && i.contains(0)) return below(2) ? R(0) : R(-0.0);
    const double lo = std::max(i.lo, -1e300), hi = std::min(i.hi, 1e300);
    if (!(lo <= hi)) return R(i.lo);
    const double u = std::uniform_real_distribution<double>(0, 1)(engine_);
    return R(std::clamp(double(R(lo + (hi - lo) * u)), i.lo, i.hi));
  }

 private:
  std::mt19937 engine_{1};
};

/// One operation in all three machines.
struct Operation {
  const char* name;
  Interval (*bounds)(const Interval&, const Interval&, const Interval&);
  float (*f32)(float, float, float);
  double (*f64)(double, double, double);
};
#define OPERATION(name, interval, real)                                               \
  Operation {                                                                         \
    name,                                                                             \
        [](const Interval& a, const Interval& b, const Interval& c) {                 \
          (void)b, (void)c;                                                           \
          return interval;                                                            \
        },                                                                            \
        [](float a, float b, float c) -> float { return (void)b, (void)c, real; },    \
        [](double a, double b, double c) -> double { return (void)b, (void)c, real; } \
  }

const Operation kOperations[] = {
    OPERATION("add", add(a, b), a + b),
    OPERATION("sub", sub(a, b), a - b),
    OPERATION("mul", mul(a, b), a* b),
    OPERATION("square", square(a), a* a),
    OPERATION("div", div(a, b), a / b),
    OPERATION("mod", mod(a, b), std::fma(-b, std::floor(a / b), a)),
    OPERATION("neg", neg(a), -a),
    OPERATION("fma", fma(a, b, c), std::fma(a, b, c)),
    OPERATION("square_fma", square_fma(a, c), std::fma(a, a, c)),
    OPERATION("blend", blend(a, b, sub(b, a), c), std::fma(b - a, c, a)),
};
#undef OPERATION

TEST_CASE("interval arithmetic encloses float and double arithmetic") {
  const int boxes = kSanitized ? 2000 : 20000;
  Random random;
  for (const Operation& op : kOperations) {
    CAPTURE(std::string(op.name));
    int outside = 0;
    for (int k = 0; k < boxes; ++k) {
      const Interval a = random.interval(), b = random.interval();
      const Interval c = k % 2 ? random.interval() : Interval{0, 1, false};
      const Interval r = op.bounds(a, b, c);
      for (int i = 0; i < 16; ++i) {
        const float f =
            op.f32(random.inside<float>(a), random.inside<float>(b), random.inside<float>(c));
        const double d =
            op.f64(random.inside<double>(a), random.inside<double>(b), random.inside<double>(c));
        outside += !r.contains(double(f)) + !r.contains(d);
      }
    }
    CHECK(outside == 0);
  }
}

TEST_CASE("interval arithmetic is exact where floats are") {
  const auto p = [](double x) { return Interval::point(x); };
  CHECK(add(p(0.5), p(0.25)) == p(0.75));
  CHECK(mul({-2, 3, false}, {-1, 4, false}) == Interval{-8, 12, false});
  CHECK(square({-2, 3, false}) == Interval{0, 9, false});
  CHECK(div({1, 2, false}, {4, 8, false}) == Interval{0.125, 0.5, false});
  CHECK(mod({3.25, 3.5, false}, p(1)) == Interval{0.25, 0.5, false});
  CHECK(mod({-0.25, -0.125, false}, p(1)) == Interval{0.75, 0.875, false});
  // Within a blend neither end is left, though a + (b - a) t counts a twice.
  const Interval a{0, 1, false}, b{1, 2, false}, t{0, 1, false};
  const Interval r = blend(a, b, sub(b, a), t);
  CHECK(r.lo >= -1e-6);
  CHECK(r.hi <= 2 + 1e-6);
  // A sum that is no float has the two around it, and nothing more.
  const Interval third = div(p(1), p(3));
  CHECK(float(third.hi) == std::nextafterf(float(third.lo), INFINITY));
}

TEST_CASE("interval division through zero is everything") {
  const Interval r = div({1, 2, false}, {-1, 1, false});
  CHECK(r.lo == -kInf);
  CHECK(r.hi == kInf);
  CHECK(!r.nan);
  CHECK(div({0, 1, false}, {-1, 1, false}).nan);
  CHECK(sub({1, kInf, false}, {1, kInf, false}).nan);
  CHECK(mul({0, 1, false}, {1, kInf, false}).nan);
}

TEST_CASE("interval integers wrap to everything") {
  const Interval most{2147483600.0, 2147483647.0, false};
  CHECK(add_integers(most, Interval::point(0)) == most);
  CHECK(add_integers(most, Interval::point(1)) == Interval::all(SlotType::Integer));
  CHECK(neg_integer(Interval::point(-2147483648.0)) == Interval::all(SlotType::Integer));
  CHECK(mul_integers({-3, 2, false}, {4, 5, false}) == Interval{-15, 10, false});
  Random random;
  int outside = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto range = [&] {
      const double lo = random.below(41) - 20;
      return Interval{lo, lo + random.below(9), false};
    };
    const Interval a = range(), b = range(), r = mod_integers(a, b);
    const auto pick = [&](const Interval& i) {
      return int(i.lo) + random.below(int(i.hi - i.lo) + 1);
    };
    const int x = pick(a), y = pick(b);
    const int floored = y == 0 ? 0 : x - y * int(std::floor(double(x) / y));
    outside += !r.contains(floored);
  }
  CHECK(outside == 0);
}

TEST_CASE("interval conversions hold what either machine makes of a number") {
  CHECK(integer_of_real({-2.75, 3.5, false}) == Interval{-2, 3, false});
  CHECK(integer_of_real({1e20, kInf, false}) == Interval::point(2147483647.0));
  CHECK(integer_of_real({5, 6, true}) == Interval{0, 6, false});
  CHECK(real_of_integer(Interval::point(16777217)) == Interval{16777216, 16777218, false});
  Constant tenth;
  tenth.f32 = 0.1f;
  tenth.f64 = 0.1;
  const Interval i = interval_of(tenth);
  CHECK(i.contains(0.1));
  CHECK(i.contains(double(0.1f)));
}

TEST_CASE("interval comparisons are three-valued and narrow their operands") {
  Random random;
  int wrong = 0, lost = 0, narrowed = 0;
  for (int k = 0; k < 40000; ++k) {
    const Interval a = random.interval(), b = random.interval();
    const auto c = static_cast<Comparison>(random.below(4));
    const Interval l = compare(c, a, b);
    for (int i = 0; i < 8; ++i) {
      const double x = random.inside<double>(a), y = random.inside<double>(b);
      const bool outcome = c == Comparison::Less        ? x < y
                           : c == Comparison::LessEqual ? x <= y
                           : c == Comparison::Equal     ? x == y
                                                        : x != y;
      wrong += !l.contains(outcome);
      Interval na = a, nb = b;
      narrow(c, outcome, false, na, nb);
      lost += !na.contains(x) || !nb.contains(y);
      narrowed += na != a || nb != b;
    }
  }
  CHECK(wrong == 0);
  CHECK(lost == 0);
  CHECK(narrowed > 10000);
  CHECK(compare(Comparison::Less, {0, 1, false}, {2, 3, false}) == logic(false, true));
  CHECK(compare(Comparison::Less, {0, 1, true}, {2, 3, false}) == logic(true, true));
  CHECK(compare(Comparison::Less, {0, 2, false}, {2, 3, false}) == logic(true, true));
}

TEST_CASE("interval narrowing of integers excludes the end") {
  Interval n{0, 10, false}, m = Interval::point(4);
  narrow(Comparison::Less, true, true, n, m);
  CHECK(n == Interval{0, 3, false});
  n = {0, 10, false};
  narrow(Comparison::LessEqual, false, true, n, m);
  CHECK(n == Interval{5, 10, false});
}

TEST_CASE("interval widening ends soon") {
  for (const SlotType type : {SlotType::Real, SlotType::Integer}) {
    Interval x = Interval::point(3);
    int steps = 0;
    for (;; ++steps) {
      const Interval grown = join(x, {x.lo - 1, x.hi + 1, false});
      const Interval next = widened(x, meet(grown, Interval::all(type)), type);
      if (next == x || steps > 100) break;
      x = next;
    }
    CHECK(steps <= 6);
    CHECK(x.lo == Interval::all(type).lo);
    CHECK(x.hi == Interval::all(type).hi);
  }
}

}  // namespace
}  // namespace mms::vm
