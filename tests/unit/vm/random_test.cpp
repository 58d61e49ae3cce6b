// SPDX-License-Identifier: Apache-2.0
// Random programs: against the reference, in different batches, and broken at random.
#include "generator.h"
#include "harness.h"
#include "tests/sanitized.h"

namespace mms::vm::test {
namespace {

template <class T>
std::vector<Point<T>> random_points(int n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Point<T>> points;
  for (int k = 0; k < n; ++k) {
    points.push_back(zero_point<T>());
    for (Cell<T>& c : points.back())
      for (T& x : c.r) x = T(int(random() % 64) - 32) / 8;
  }
  return points;
}

TEST_CASE_TEMPLATE("random programs agree with the reference", T, float, double) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const Program p = Generator(seed).program(seed % 2);
    check_against_reference<T>(p, 0, random_points<T>(37, seed));
  }
}

TEST_CASE_TEMPLATE("random programs do not depend on the batch", T, float, double) {
  Interpreter<T> machine(64);
  for (std::uint32_t seed = 1000; seed < 1200; ++seed) {
    CAPTURE(seed);
    const Program p = Generator(seed).program(true);
    REQUIRE(fault_text(p) == "");
    const Executable exe(p);
    auto points = random_points<T>(40, seed);
    const auto forward = run(machine, exe, p, 0, points);
    std::reverse(points.begin(), points.end());
    points.resize(29, zero_point<T>());
    const auto backward = run(machine, exe, p, 0, points);
    for (int k = 0; k < 29; ++k) CHECK(forward[39 - k] == backward[k]);
    for (int k = 0; k < 29; k += 9) CHECK(run(machine, exe, p, 0, {points[k]})[0] == backward[k]);
  }
}

/// Breaks a program in one place.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  void mutate(Program& p) {
    Function& f = p.functions[pick(p.functions.size())];
    if (f.code.empty()) return;
    const std::size_t at = pick(f.code.size());
    switch (pick(12)) {
      case 0:
        f.code[at].op = static_cast<Op>(pick(kOpCount + 1));
        break;
      case 1:
        f.code[at].a = std::uint32_t(pick(8));
        break;
      case 2:
        f.code[at].a = std::uint32_t(random_());
        break;
      case 3:
        f.code[at].b = std::uint32_t(pick(16));
        break;
      case 4:
        std::swap(f.code[at], f.code[pick(f.code.size())]);
        break;
      case 5:
        f.code.erase(f.code.begin() + std::ptrdiff_t(at));
        f.lines.pop_back();
        break;
      case 6:
        f.code.insert(f.code.begin() + std::ptrdiff_t(at), f.code[pick(f.code.size())]);
        f.lines.push_back({});
        break;
      case 7:
        retype(f.locals);
        break;
      case 8:
        retype(f.results);
        break;
      case 9:
        if (!p.block_types.empty()) retype(p.block_types[pick(p.block_types.size())]);
        break;
      case 10:
        if (!p.constants.empty()) p.constants[pick(p.constants.size())].type = type();
        break;
      case 11: {  // another instruction of the same effect
        const OpInfo& row = info(f.code[at].op);
        const std::size_t other = pick(kOpCount);
        if (kOps[other].pops == row.pops && kOps[other].pushes == row.pushes)
          f.code[at].op = static_cast<Op>(other);
        break;
      }
    }
  }

 private:
  std::size_t pick(std::size_t n) { return random_() % n; }
  SlotType type() { return static_cast<SlotType>(pick(5)); }
  void retype(std::vector<SlotType>& types) {
    if (types.empty() || pick(3) == 0)
      types.push_back(type());
    else if (pick(2))
      types[pick(types.size())] = type();
    else
      types.pop_back();
  }
  std::mt19937 random_;
};

TEST_CASE("a program broken at random is refused, or runs and both builds agree") {
  constexpr int kPrograms = kSanitized ? 1500 : 6000;
  int refused = 0, ran = 0;
  Interpreter<float> best(16), baseline(16, Isa::Baseline);
  for (std::uint32_t seed = 0; seed < kPrograms; ++seed) {
    CAPTURE(seed);
    Program p = Generator(seed % 600).program(seed % 16 == 0);
    Mutator mutator(seed);
    for (std::uint32_t k = 0; k <= seed % 3; ++k) mutator.mutate(p);
    disassemble(p);
    if (verify(p)) {
      ++refused;
      continue;
    }
    ++ran;
    const Executable exe(p);
    const auto points = random_points<float>(7, seed);
    CHECK(run(best, exe, p, 0, points) == run(baseline, exe, p, 0, points));
  }
  CHECK(refused > kPrograms / 6);
  CHECK(ran > kPrograms / 20);
}

}  // namespace
}  // namespace mms::vm::test
