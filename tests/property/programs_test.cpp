// SPDX-License-Identifier: Apache-2.0
// Random scripts, each run in every way that must not matter: levels, batches of any length, both
// builds of the machine, stored and loaded again, and constants in place of variables, so that the
// linker folds it all. These give the same bits; the double machine is near by the bound of
// bounded.h.
//
// MMS_PROPERTY_PROGRAMS in the environment says how many (default 1200), MMS_PROPERTY_FIRST which
// seed is the first (default 1).
#include <doctest/doctest.h>

#include <map>
#include <memory>

#include "tests/golden/evaluate.h"
#include "tests/golden/reload.h"
#include "tests/property/bounded_machine.h"
#include "tests/property/generator.h"
#include "tests/sanitized.h"
#include "tests/setting.h"

namespace mms::property {
namespace {

using namespace golden;

/// What has been compared, over all programs.
struct Tally {
  long programs = 0, same_bits = 0, folded = 0;
  long near = 0, exact = 0, undecided = 0;  ///< values of both machines
  double worst = 0;                         ///< distance over bound
};

/// A bound says something where it is below this share of the value, or of 1 if that is larger.
constexpr double kTight = 0x1p-10;
/// Lanes whose values are compared with the double machine.
constexpr int kDoubleLanes[] = {1, 2, 5};
/// Lanes of the largest batch that is compared.
constexpr int kMostLanes = kSanitized ? 32 : 512;

/// Machines that are kept between programs: they are costly to make.
template <class R>
class Machines {
 public:
  vm::Interpreter<R>& of(int width, vm::Isa isa) {
    return all_.try_emplace({width, isa}, width, isa).first->second;
  }

 private:
  std::map<std::pair<int, vm::Isa>, vm::Interpreter<R>> all_;
};

/// A script that is linked, ready to run, with all it computes.
struct Linked {
  Linked(std::span<const lang::Graph> graphs, lang::Level level) {
    lang::LinkOptions options;
    options.level = level;
    lang::Diagnostics diagnostics;
    linked = lang::link(graphs, api::standard_library(), options, diagnostics);
    errors = lang::render(diagnostics);
    if (!linked) return;
    executable.emplace(program());
    points = points_of(program());
  }
  const vm::Program& program() const { return linked->program; }

  template <class R>
  Run run(Machines<R>& machines, std::size_t point, vm::InputBatch<R>& in, int lanes,
          vm::Isa isa = vm::Isa::Best) const {
    return evaluate(machines.of(in.width(), isa), program(), *executable, points[point], in, lanes);
  }

  std::optional<lang::Linked> linked;
  std::string errors;
  std::optional<vm::Executable> executable;
  std::vector<Point> points;
};

/// All comparisons of one program.
class Comparison {
 public:
  Comparison(std::uint32_t seed, Tally& tally, Machines<float>& m32, Machines<double>& m64)
      : seed_(seed),
        tally_(tally),
        m32_(m32),
        m64_(m64),
        body_(Generator(seed).script()),
        script_(variables({}) + body_) {}

  std::vector<std::string> failures;
  const std::string& script() const { return script_; }

  void run() {
    const auto graphs = parse(script_);
    const Linked best(graphs, lang::Level::O2);
    if (!best.linked) return failures.push_back("it does not link: " + best.errors);
    ++tally_.programs;
    levels_and_batches(best, graphs);
    stored(best);
    folded(best);
    doubles(best);
  }

 private:
  void report(std::size_t point, const Linked& l, std::string what) {
    failures.push_back(fmt::format("seed {}: {}: {}", seed_, l.points[point].name, what));
  }

  /// The first `lanes` lanes of `a`, from `first_lane`, have the bits of `b`.
  void same(const Linked& l, std::size_t point, const Run& a, const Run& b, int first_lane,
            int lanes, const char* how) {
    if (a.values.size() != b.values.size())
      return report(point, l, fmt::format("another number of results ({})", how));
    for (std::size_t k = 0; k < a.values.size(); ++k)
      for (int i = 0; i < lanes; ++i, ++tally_.same_bits) {
        const double x = a.values[k][static_cast<std::size_t>(first_lane + i)],
                     y = b.values[k][static_cast<std::size_t>(i)];
        if (!golden::same_bits(x, y))
          return report(
              point, l,
              fmt::format("slot {} of lane {}: {} or {} ({})", k, first_lane + i, x, y, how));
      }
  }

  static std::vector<lang::Graph> parse(const std::string& text) {
    lang::Diagnostics diagnostics;  // a script that does not parse will not link
    return {lang::parse(lang::make_source("random.mms", text), diagnostics)};
  }

  void levels_and_batches(const Linked& best, std::span<const lang::Graph> graphs) {
    const Linked lower[] = {Linked(graphs, lang::Level::O1), Linked(graphs, lang::Level::O0)};
    const int width = std::min(best.executable->width(), kMostLanes);
    auto in = points<float>(width, seed_);
    for (std::size_t k = 0; k < best.points.size(); ++k) {
      const Run whole = best.run(m32_, k, in, width);
      for (const Linked& l : lower) {
        if (!l.linked || l.points.size() != best.points.size())
          return report(k, best, "it links at some levels only");
        const Run other = l.run(m32_, k, in, width);
        same(best, k, whole, other, 0, width, &l == lower ? "O2 and O1" : "O2 and O0");
        if (other.faults.size() != whole.faults.size()) report(k, best, "other faults");
      }
      for (const int lanes : {1, 3, 13, 17})
        same(best, k, whole, best.run(m32_, k, in, lanes), 0, lanes, "a batch that is not full");
      same(best, k, whole, best.run(m32_, k, in, 17, vm::Isa::Baseline), 0, 17,
           "the baseline build");
      for (const int lane : {2, width - 1}) {
        auto one = alone(in, lane);
        same(best, k, whole, best.run(m32_, k, one, 1), lane, 1, "a lane alone");
      }
    }
  }

  void stored(const Linked& best) {
    const vm::Program program = golden::reloaded(*best.linked, failures);
    const vm::Executable executable(program);
    auto in = points<float>(vm::kLaneMultiple, seed_);
    for (std::size_t k = 0; k < best.points.size(); ++k) {
      auto& machine = m32_.of(in.width(), vm::Isa::Best);
      const Run again = evaluate(machine, program, executable, best.points[k], in, in.width());
      same(best, k, best.run(m32_, k, in, in.width()), again, 0, in.width(), "stored and loaded");
    }
  }

  /// Eighths, which are the same in text and in float, in place of the variables. (Not in double: a
  /// program decides a known comparison once, by its floats.)
  void folded(const Linked& best) {
    std::mt19937 random(seed_);
    std::vector<float> numbers;
    auto in = points<float>(vm::kLaneMultiple);
    for (const VariableRead& read : kReads) {
      numbers.push_back((float(random() % 33) - 16) / 8);
      in.lanes(read.variable, read.component)[0] = numbers.back();
    }
    const Linked constant(parse(variables(numbers) + body_), lang::Level::O2);
    if (!constant.linked)
      return failures.push_back("it does not link with constants: " + constant.errors);
    for (std::size_t k = 0; k < best.points.size(); ++k)
      same_folded(best, k, best.run(m32_, k, in, 1), constant.run(m32_, k, in, 1));
  }

  void same_folded(const Linked& best, std::size_t k, const Run& a, const Run& b) {
    // Folded materials have other numbers: those of an arm that is not taken are 0, or not there.
    const std::string& name = best.points[k].name;
    const bool materials = name.ends_with(".shade") || name.ends_with(".emit");
    const std::size_t before = name.ends_with(".shade") ? 3 * kWavelengths + 2 : kWavelengths;
    const std::size_t slots = std::min(materials ? before : a.values.size(), a.values.size());
    for (std::size_t s = 0; s < slots; ++s, ++tally_.folded)
      if (!golden::same_bits(a.values[s][0], b.values[s][0]))
        return report(k, best,
                      fmt::format("slot {}: {} or, folded, {}", s, a.values[s][0], b.values[s][0]));
  }

  void doubles(const Linked& best) {
    auto in = points<float>(vm::kLaneMultiple, seed_);
    auto in64 = points<double>(vm::kLaneMultiple, seed_);
    std::vector<BoundedMachine> machines;
    for (const int lane : kDoubleLanes)
      machines.emplace_back(best.program(), inputs(in, in64, lane));
    for (std::size_t k = 0; k < best.points.size(); ++k) {
      const Run f = best.run(m32_, k, in, vm::kLaneMultiple),
                d = best.run(m64_, k, in64, vm::kLaneMultiple);
      for (std::size_t l = 0; l < machines.size(); ++l)
        near(best, k, machines[l], f, d, kDoubleLanes[l]);
    }
  }

  /// The results of a machine that carries bounds; none where it cannot tell the way, or runs long.
  static std::optional<BoundedMachine::Values> bounds(BoundedMachine& machine,
                                                      std::uint32_t function) {
    try {
      return machine.run(function);
    } catch (const Unsure&) {
    } catch (const BoundedMachine::GivenUp&) {
    }
    return std::nullopt;
  }

  /// Every value of a lane lies where `machine` says.
  void near(const Linked& best, std::size_t k, BoundedMachine& machine, const Run& f, const Run& d,
            int lane) {
    const Point& point = best.points[k];
    const auto at = static_cast<std::size_t>(lane);
    std::optional<BoundedMachine::Values> results;
    if (point.function) results = bounds(machine, *point.function);
    std::size_t slot = 0;
    for (const vm::ValueSource& source : point.sources) {
      if (source.constant) {  // stated in the script, or folded: compared there
        slot += static_cast<std::size_t>(vm::block_count(source.type));
        continue;
      }
      for (int c = 0; c < vm::block_count(source.type); ++c, ++slot) {
        const double x = f.values[slot][at], y = d.values[slot][at];
        if (!results) {
          ++tally_.undecided;
          continue;
        }
        const BoundedCell& cell = (*results)[source.index];
        const bool real =
            source.type == vm::SlotType::Real || source.type == vm::SlotType::Spectrum;
        const Bounded b = real ? cell.r[static_cast<std::size_t>(c)]
                               : Bounded{double(cell.i), cell.sure ? 0.0 : kInfinity};
        if (!golden::same_bits(b.v, y) && !(b.v == 0 && y == 0))
          return report(k, best,
                        fmt::format("slot {} of lane {}: the double machine has {}, the "
                                    "plain one {}",
                                    slot, lane, y, b.v));
        if (!judge(x, y, b.e))
          return report(k, best,
                        fmt::format("slot {} of lane {}: float {}, double {}, bound {}", slot, lane,
                                    x, y, b.e));
      }
    }
  }

  /// Counts a value; false where it is farther than its bound.
  bool judge(double x, double y, double e) {
    if (!(e < kInfinity)) {
      ++tally_.undecided;
      return true;
    }
    ++(!(e <= kTight * std::max(1.0, std::fabs(y))) ? tally_.undecided
       : e > 0                                      ? tally_.near
                                                    : tally_.exact);
    if (golden::same_bits(x, y) || x == y) return true;
    const double distance = std::fabs(x - y);
    if (!(distance <= e * (1 + 0x1p-20))) return false;
    tally_.worst = std::max(tally_.worst, distance / e);
    return true;
  }

  static BoundedMachine::Values inputs(vm::InputBatch<float>& in, vm::InputBatch<double>& in64,
                                       int lane) {
    BoundedMachine::Values all;
    for (const vm::VariableInfo& v : vm::kVariables) {
      const bool spectrum = v.slot_type() == vm::SlotType::Spectrum;
      for (int c = 0; c < v.components(); ++c) {
        BoundedCell cell;
        for (int w = 0; w < (spectrum ? kWavelengths : 1); ++w) {
          const double d = in64.lanes(v.variable, spectrum ? w : c)[lane];
          cell.r[static_cast<std::size_t>(w)] = {
              d, std::fabs(double(in.lanes(v.variable, spectrum ? w : c)[lane]) - d)};
        }
        all.push_back(cell);
      }
    }
    return all;
  }

  std::uint32_t seed_;
  Tally& tally_;
  Machines<float>& m32_;
  Machines<double>& m64_;
  std::string body_, script_;
};

TEST_CASE("random programs: all ways to run one agree, and the double machine is near") {
  const int first = int(setting("MMS_PROPERTY_FIRST", 1)),
            count = int(setting("MMS_PROPERTY_PROGRAMS", kSanitized ? 40 : 1200));
  Tally tally;
  Machines<float> m32;
  Machines<double> m64;
  bool shown = false;
  for (int seed = first; seed < first + count; ++seed) {
    Comparison c(static_cast<std::uint32_t>(seed), tally, m32, m64);
    c.run();
    for (const std::string& f : c.failures) FAIL_CHECK(f);
    if (!c.failures.empty() && !std::exchange(shown, true)) MESSAGE(c.script());
  }
  const double values = double(tally.near + tally.exact + tally.undecided);
  MESSAGE(fmt::format(
      "{} programs: {} values with equal bits, {} folded; float and double: {} near by their bound "
      "(at most {:.3f} of it), {} exact, {:.2f}% undecided",
      tally.programs, tally.same_bits, tally.folded, tally.near, tally.worst, tally.exact,
      100 * double(tally.undecided) / values));
  CHECK(tally.folded > 20 * count);
  // Undecided: a branch or a value that hangs on a comparison nearer than the error, a value out of
  // float's range, and any whose bound is above kTight.
  CHECK(double(tally.undecided) < 0.1 * values);
}

}  // namespace
}  // namespace mms::property
