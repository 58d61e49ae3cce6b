// SPDX-License-Identifier: Apache-2.0
// Enclosures: whatever the float and the double machine return for a point of a box lies in what
// the interval machine returns for the box. Rows one by one, random programs as a whole.
// MMS_PROPERTY_PROGRAMS in the environment says how many programs (default 300), MMS_BOUNDS_POINTS
// how many points of each row (default 16384).
#include "vm/bounds.h"

#include <doctest/doctest.h>

#include "generator.h"
#include "materials/spectra.h"
#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"
#include "tests/setting.h"
#include "tests/unit/stdlib/rows.h"

namespace mms::property {
namespace {

using namespace golden;
using vm::Interval;

class Boxes {
 public:
  explicit Boxes(std::uint32_t seed) : random_(seed), edges_(stdlib::testing::edges()) {}

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  /// A float: an edge value, any bits, or an everyday number.
  double number() {
    switch (below(8)) {
      case 0:
        return edges_[static_cast<std::size_t>(below(static_cast<int>(edges_.size())))];
      case 1:
        return stdlib::testing::any_float(random_);
      case 2:
        return below(9) - 4;
      default:
        return static_cast<float>((unit() * 2 - 1) * std::pow(10.0, below(4) - 1));
    }
  }
  /// An interval of reals, often narrow, sometimes a point, sometimes with NaN.
  Interval reals() {
    double a = number();
    while (std::isnan(a)) a = number();
    double b = a;
    const int how = below(6);
    if (how == 1) b = a + std::fabs(a) * 1e-6;
    if (how == 2) b = a + std::pow(10.0, -below(5)) * unit();
    if (how >= 3) b = number();
    if (std::isnan(b)) b = a;
    Interval i = vm::reals(std::min(a, b), std::max(a, b));
    i.nan = below(20) == 0;
    return i;
  }
  /// An interval of integers whose ends are floats.
  Interval integers() {
    const auto one = [&] {
      return below(4) ? double(below(21) - 10)
                      : double(int(static_cast<std::int32_t>(random_()) & ~0xff));
    };
    const double a = one(), b = below(2) ? a : one();
    return {std::min(a, b), std::max(a, b), false};
  }
  /// What rows of optics are made for.
  Interval physical(std::size_t param) {
    const double base = param == 0 ? 300e-9 + 600e-9 * unit() : 2000 * unit();
    return vm::reals(base, base * (1 + (below(2) ? 0.3 : 0.001) * unit()));
  }

  /// A value of the interval: its ends, then anything between; a float where `R` is.
  template <class R>
  R inside(const Interval& i, int lane) {
    if (i.nan && below(4) == 0) return std::numeric_limits<R>::quiet_NaN();
    if (lane == 0) return R(i.lo);
    if (lane == 1) return R(i.hi);
    if (i.contains(0) && below(8) == 0) return below(2) ? R(0) : R(-0.0);
    const double low = std::max(i.lo, -1e300), high = std::min(i.hi, 1e300);
    if (!(low <= high)) return R(i.lo);
    double x = low + (high - low) * unit();
    // Orders of magnitude below, too.
    if (below(4) == 0 && i.contains(0)) x *= std::pow(10.0, -40 * unit());
    if (below(16) == 0 && i.contains_infinity()) x = i.hi == Interval::kInf ? i.hi : i.lo;
    return static_cast<R>(std::clamp(double(R(x)), i.lo, i.hi));
  }

 private:
  std::mt19937 random_;
  std::vector<float> edges_;
};

constexpr int kLanes = 64;

std::string shown(const Interval& i) {
  return fmt::format("[{}, {}]{}", i.lo, i.hi, i.nan ? " or NaN" : "");
}

/// Runs a row in one of the machines at points of a box; what lies outside the enclosure, or empty.
template <class R>
std::string outside(const vm::Builtin& row, const std::vector<Interval>& box,
                    const std::vector<Interval>& enclosure, Boxes& random) {
  const stdlib::testing::Shape shape = stdlib::testing::shape_of(row);
  std::vector<std::vector<R>> columns(box.size(), std::vector<R>(kLanes));
  for (std::size_t k = 0; k < box.size(); ++k)
    for (int lane = 0; lane < kLanes; ++lane) {
      R x = random.inside<R>(box[k], lane < 4 ? (lane >> (k % 2)) & 1 : lane);
      if (shape.params[k] == 'i') x = R(std::clamp(std::floor(double(x)), box[k].lo, box[k].hi));
      columns[k][static_cast<std::size_t>(lane)] = x;
    }
  const auto out = stdlib::testing::run<R>(row, columns);
  for (std::size_t r = 0; r < out.size(); ++r)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (enclosure[r].contains(double(out[r][lane]))) continue;
      std::string text =
          fmt::format("{} {} of", sizeof(R) == 4 ? "float" : "double", row.signature);
      for (std::size_t k = 0; k < box.size(); ++k)
        text += fmt::format(" {} in {},", columns[k][lane], shown(box[k]));
      return text + fmt::format(" is {}, not in {}", out[r][lane], shown(enclosure[r]));
    }
  return "";
}

std::vector<vm::SlotType> types_of(const std::string& letters) {
  std::vector<vm::SlotType> types;
  for (const char c : letters)
    types.push_back(c == 'r'   ? vm::SlotType::Real
                    : c == 'i' ? vm::SlotType::Integer
                               : vm::SlotType::Logic);
  return types;
}

TEST_CASE("bounds: every row encloses both kernels over random and edge boxes") {
  const int points = int(setting("MMS_BOUNDS_POINTS", kSanitized ? 2048 : 16384));
  Boxes random(7);
  for (const vm::Builtin& row : stdlib::builtins()) {
    if (!row.f32) continue;
    CAPTURE(row.signature);
    // Every row says what is known of its results.
    CHECK(row.bounds.form != vm::BoundsForm::None);
    const stdlib::testing::Shape shape = stdlib::testing::shape_of(row);
    const bool optics = row.signature.find("wavelength") != row.signature.npos;
    int failures = 0;
    std::string first;
    for (int done = 0; done < points; done += 2 * kLanes) {
      std::vector<Interval> box;
      const bool everyday = optics && random.below(2);
      for (std::size_t k = 0; k < shape.params.size(); ++k)
        box.push_back(shape.params[k] != 'r'        ? random.integers()
                      : everyday && k % 2 == 0 && k ? random.reals()
                      : everyday                    ? random.physical(k)
                                                    : random.reals());
      std::vector<Interval> enclosure(shape.results.size());
      vm::enclose_row(row, types_of(shape.results), box, enclosure);
      for (const std::string& text : {outside<float>(row, box, enclosure, random),
                                      outside<double>(row, box, enclosure, random)}) {
        if (text.empty()) continue;
        if (failures++ == 0) first = text;
      }
    }
    CHECK_MESSAGE(failures == 0, failures, " boxes, the first: ", first);
  }
}

TEST_CASE("bounds: monotone rows are tight at points") {
  Boxes random(11);
  for (const vm::Builtin& row : stdlib::builtins()) {
    if (!row.f32 || row.bounds.form != vm::BoundsForm::Exact) continue;
    CAPTURE(row.signature);
    const stdlib::testing::Shape shape = stdlib::testing::shape_of(row);
    const bool table = row.signature.find("(real wavelength, table)") != row.signature.npos;
    int compared = 0, wide = 0;
    double widest = 0;
    for (int round = 0; round < 400; ++round) {
      std::vector<Interval> box;
      for (const char c : shape.params)
        box.push_back(table && !box.empty() ? Interval::point(random.below(40))
                      : c != 'r'            ? Interval::point(random.below(9) - 4)
                      : table ? Interval::point(float(300e-9 + 600e-9 * random.unit()))
                              : Interval::point(float(3 * random.unit())));
      std::vector<Interval> enclosure(shape.results.size());
      vm::enclose_row(row, types_of(shape.results), box, enclosure);
      for (const Interval& r : enclosure) {
        if (!r.has_number() || r.contains_infinity()) continue;
        ++compared;
        // Both ends miss the result by what the kernel may, and are rounded outward.
        const double ulp = std::max(r.magnitude(), 1e-30) * 0x1p-23;
        const double allowed = (2 * row.max_ulp + 2) * ulp;
        widest = std::max(widest, r.width() / ulp);
        wide += r.width() > allowed;
      }
    }
    CHECK_MESSAGE(wide == 0, wide, " of ", compared, " too wide; the widest: ", widest, " ulp");
    CHECK(compared >= 100);
  }
}

/// A box around what `points` gives, of one of several sizes.
vm::Box random_box(Boxes& random, double size) {
  vm::Box box = vm::Box::unit_sphere();
  for (std::size_t k = 0; k < box.inputs.size(); ++k) {
    if (vm::input_type(int(k)) == vm::SlotType::Spectrum) continue;
    const double centre = float(4 * random.unit() - 2);
    box.inputs[k] = vm::reals(centre - size * random.unit(), centre + size * random.unit());
  }
  return box;
}

template <class R>
void fill(vm::InputBatch<R>& in, const vm::Box& box, Boxes& random) {
  api::fill_defaults(in);
  for (int k = 0; k < vm::input_count(); ++k) {
    const vm::Variable v = vm::input_variable(k);
    if (vm::input_type(k) == vm::SlotType::Spectrum) continue;
    const int component = k - vm::input_index(v);
    for (int i = 0; i < in.width(); ++i)
      in.lanes(v, component)[i] =
          random.inside<R>(box.inputs[static_cast<std::size_t>(k)], random.below(6));
  }
}

/// Checks every value of `point` in one machine; how many values were compared.
template <class R>
int check_program(const vm::Program& program, const vm::Executable& executable, const Point& point,
                  const std::vector<Interval>& enclosures, const vm::Box& box, Boxes& random,
                  std::string& failure) {
  vm::InputBatch<R> in(kLanes);
  fill(in, box, random);
  const Run r = evaluate(program, executable, point, in, kLanes);
  std::size_t slot = 0;
  int compared = 0;
  for (std::size_t s = 0; s < point.sources.size(); ++s)
    for (int c = 0; c < vm::block_count(point.sources[s].type); ++c, ++slot)
      for (const double value : r.values[slot]) {
        ++compared;
        if (!enclosures[s].contains(value) && failure.empty())
          failure =
              fmt::format("{} {} source {}: {} is not in {}", sizeof(R) == 4 ? "float" : "double",
                          point.name, s, value, shown(enclosures[s]));
      }
  return compared;
}

TEST_CASE("bounds: random programs stay in their enclosures") {
  const int programs = int(setting("MMS_PROPERTY_PROGRAMS", kSanitized ? 40 : 300));
  Boxes random(3);
  long compared = 0, bounded = 0, sources = 0;
  for (int seed = 1; seed <= programs; ++seed) {
    const Compiled c = compile(variables({}) + Generator(static_cast<std::uint32_t>(seed)).script(),
                               seed % 3 ? lang::Level::O2 : lang::Level::O0);
    CAPTURE(seed);
    REQUIRE(c.linked);
    const vm::Program& p = c.linked->program;
    const vm::Executable executable(p);
    vm::BoundsMachine machine(p);
    for (const double size : {0.0, 1e-3, 0.1, 2.0}) {
      const vm::Box box = random_box(random, size);
      for (const Point& point : points_of(p)) {
        std::vector<Interval> enclosures;
        vm::Enclosure e;
        if (point.function) e = machine.run(*point.function, box);
        for (const vm::ValueSource& s : point.sources) {
          enclosures.push_back(s.constant ? vm::interval_of(p.constants[s.index])
                                          : e.results[s.index]);
          ++sources;
          bounded += !enclosures.back().contains_infinity();
        }
        std::string failure;
        compared += check_program<float>(p, executable, point, enclosures, box, random, failure);
        compared += check_program<double>(p, executable, point, enclosures, box, random, failure);
        CHECK_MESSAGE(failure.empty(), "box of size ", size, ": ", failure);
      }
    }
  }
  CHECK(compared > 10000L * programs / 10);
  // An enclosure of everything would pass the rest: most are finite.
  CHECK(bounded * 10 > sources * 6);
  MESSAGE(bounded, " of ", sources, " enclosures are finite");
}

/// The enclosure of `real out() = ...;` after `definitions`, over the unit sphere's box.
vm::Enclosure enclosure_of(const std::string& definitions, const std::string& expression,
                           const vm::Box& box = vm::Box::unit_sphere()) {
  const Compiled c = compile(definitions + "real out() = " + expression + ";\n");
  INFO(c.text_of_errors());
  REQUIRE(c.linked);
  vm::BoundsMachine machine(c.linked->program);
  return machine.run(c.linked->program.exports.at(0).function, box);
}

TEST_CASE("bounds: what occurs twice is seen to be one value") {
  const auto bounds = [](const std::string& e) { return enclosure_of("", e).results.at(0); };
  const std::string x = "$position.x", t = "(0.5 + 0.5 * $position.x)";
  CHECK(bounds(x + " - " + x) == Interval::point(0));
  CHECK(bounds(x + " * " + x) == Interval{0, 1, false});
  // The smooth step of [0, 1], and a cubic whose turns lie inside: x^3 - x/2 at sqrt(1/6).
  const Interval smooth = bounds("smoothstep(0.0, 1.0, " + t + ")");
  CHECK(smooth.lo > -2e-6);
  CHECK(smooth.hi < 1 + 2e-6);
  const Interval cubic = bounds(x + " * " + x + " * " + x + " - 0.5 * " + x);
  CHECK(cubic.hi < 0.5 + 1e-5);
  // A blend stays between what it blends.
  const Interval blend = bounds("mix(2.0, sin(9 * $position.y), " + t + ")");
  CHECK(blend.lo > -1 - 1e-5);
  CHECK(blend.hi < 2 + 1e-5);
}

TEST_CASE("bounds: noise over a small box is about as wide as it is steep") {
  // A box of edge 0.01, with a seed; how steep the noises are at most a unit, and twice that for
  // what the parts of an expression do not know of one another.
  const struct {
    const char* call;
    double steepest;
  } noises[] = {{"simplex(p, 7)", 8},
                {"worley_f1(p, 7)", 2},
                {"worley_f2(p, 7)", 2},
                {"worley_f1(p, 7, chebyshev)", 2},
                {"worley_f2(p, 7, 3.0)", 2},
                {"worley_f3(p, 7, manhattan)", 2},
                {"worley_gap(p, 7)", 2},
                {"worley_edge(p, 7)", 2},
                {"worley_f3([p[0], p[1], 0.4, 0.7], 7)", 2},
                {"worley_edge([p[0], p[1], 0.4, 0.7], 7)", 2},
                {"cellnoise(p, 7)", 0},
                {"gabor(p, [2, 1], 7)", 40},
                {"gabor_isotropic(p, 2.0, 7)", 40}};
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 9);
  for (const auto& noise : noises) {
    CAPTURE(noise.call);
    std::vector<double> widths;
    for (int k = 0; k < (kSanitized ? 5 : 25); ++k) {
      const std::string p = fmt::format("[{} + 0.005 * $position.x, {} + 0.005 * $position.y]",
                                        unit(random), unit(random));
      const Compiled c = compile("real f(real[2] p) = " + std::string(noise.call) +
                                 ";\nreal out() = f(" + p + ");\n");
      REQUIRE(c.linked);
      vm::BoundsMachine machine(c.linked->program);
      const auto function = c.linked->program.exports.at(0).function;
      const Interval bounds = machine.run(function, vm::Box::unit_sphere()).results.at(0);
      CHECK(!bounds.nan);
      widths.push_back(bounds.width());
      const vm::Executable executable(c.linked->program);
      auto in = golden::points<float>(64, std::uint32_t(k));
      for (int axis = 0; axis < 2; ++axis)
        for (int i = 0; i < 64; ++i) {
          float& x = in.lanes(vm::Variable::Position, axis)[i];
          x = std::clamp(x, -1.0f, 1.0f);
        }
      const auto run = golden::run(c.linked->program, executable, function, in, 64);
      for (int i = 0; i < 64; ++i) CHECK(bounds.contains(run.values[0][std::size_t(i)]));
    }
    // The median: now and then a cell's border or another point is near.
    std::nth_element(widths.begin(), widths.begin() + widths.size() / 2, widths.end());
    CHECK(widths[widths.size() / 2] <= 2 * 0.01 * noise.steepest + 1e-4);
  }
}

TEST_CASE("bounds: a colour stays between its parts at every wavelength") {
  for (double nm = kLambdaMin - 1; nm <= kLambdaMax + 1; nm += 0.01) {
    const double red = materials::rgb_red(nm), green = materials::rgb_green(nm);
    if (!(red >= 0 && green >= 0 && red + green <= 1)) FAIL(nm);
  }
  const auto bounds = [](const std::string& c) {
    const Compiled script = compile("surface s emission = " + c + "; end");
    REQUIRE(script.linked);
    const vm::Program& p = script.linked->program;
    vm::BoundsMachine machine(p);
    const vm::Descriptor& d = p.descriptors.at(0);
    return vm::enclose(machine, p, d.emit, d.emit.emission, vm::Box::unit_sphere());
  };
  for (const char* c : {"rgb(0.75, 0.5, 0.25)", "rgb($uv.x, 0.25 + 0.5 * $uv.y, 0.25)",
                        "rgb(0.3, 0.5 * $uv.x, 0.5 * $uv.y)"}) {
    CAPTURE(c);
    const Interval i = bounds(c);
    CHECK(i.lo > -1e-5);
    CHECK(i.hi < (std::string(c)[4] == '0' ? 0.75 : 1) + 1e-5);
  }
}

TEST_CASE("bounds: arms know what their condition says") {
  const auto bounds = [](const std::string& e) { return enclosure_of("", e).results.at(0); };
  // Neither division meets the zero that the condition keeps away.
  const Interval inverse =
      bounds("select 1 / $position.x, if $position.x > 0.5; 0.0 otherwise; end");
  CHECK(inverse == Interval{0, 2, false});
  CHECK(bounds("select $position.x, if $position.x >= 0; -$position.x otherwise; end") ==
        Interval{0, 1, false});
  // A condition that is always so has one arm.
  CHECK(bounds("select 3.0, if $position.x < 2; $position.x / 0 otherwise; end") ==
        Interval::point(3));
}

TEST_CASE("bounds: loops that end are followed, others are widened, and every run ends") {
  const std::string halves =
      "real halves(real x, integer n) = select x, if n <= 0; halves(0.5 * x + 1, n - 1) otherwise "
      "end;\n";
  const vm::Enclosure followed = enclosure_of(halves, "halves($position.x, 200)");
  CHECK(!followed.widened);
  CHECK(followed.results[0].lo >= 1.99);
  CHECK(followed.results[0].hi <= 2.01);

  // As many steps as a point asks for: the parameter grows without end, the counter does not.
  const std::string grow =
      "real grow(real x, integer n) = select x, if n <= 0; grow(x + 1, n - 1) otherwise end;\n";
  const vm::Enclosure widened = enclosure_of(grow, "grow(0.0, integer(1e5 * $position.x))");
  CHECK(widened.widened);
  CHECK(widened.results[0].contains(0));
  CHECK(widened.results[0].contains(100000));

  // Not in tail position, and twice: 2^n calls, each deeper than the cap.
  const std::string tree =
      "real tree(integer n) = select 0.0, if n <= 0; tree(n - 1) + tree(n - 2) otherwise end;\n";
  const vm::Enclosure deep = enclosure_of(tree, "tree(integer(200 + $position.x))");
  CHECK(deep.widened);
  CHECK(deep.results[0].contains(0));

  // A lane that the machine gives up holds zero.
  const std::string endless =
      "real endless(real x) = select 7.0, if x == 2; endless(x) otherwise end;\n";
  const vm::Enclosure never = enclosure_of(endless, "endless($position.x)");
  CHECK(never.results[0].contains(0));
}

}  // namespace
}  // namespace mms::property
