// SPDX-License-Identifier: Apache-2.0
// Every noise and pattern that docs/stdlib.md shows, as its picture's script calls it: a lane alone
// gives the bits of its batch, and floats are near doubles.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "stdlib/stdlib.h"
#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"
#include "tests/source_dir.h"

namespace mms::golden {
namespace {

std::string text_of(const char* name) {
  std::ifstream in(mms::source_dir() / "examples/figures" / name);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Both scripts in one, so that nothing is imported.
std::string script() {
  std::string text = text_of("library.mms");
  const std::string import = "import \"screen.mms\";";
  const std::size_t at = text.find(import);
  REQUIRE(at != text.npos);
  return text.replace(at, import.size(), text_of("screen.mms"));
}

/// Points of the unit square, as the pictures see them.
template <class R>
vm::InputBatch<R> picture_points(int lanes) {
  vm::InputBatch<R> in = points<R>(lanes, 5);
  for (int c = 0; c < 2; ++c)
    for (int i = 0; i < lanes; ++i) {
      R& x = in.lanes(vm::Variable::Position, c)[i];
      x = R(0.5f + float(x) / 4.0625f);  // from [-2, 2]; the same number in either machine
    }
  // Pixels of a picture 100 wide.
  const vm::Variable f = vm::Variable::Footprint;
  for (int c = 0; c < components(f); ++c)
    for (int i = 0; i < lanes; ++i) in.lanes(f, c)[i] = R(c == 0 || c == 3 ? 0.01f : 0.0f);
  return in;
}

TEST_CASE("every noise and pattern in a picture: lanes, batches, floats and doubles") {
  const Compiled c = compile(script());
  REQUIRE_MESSAGE(c.linked, c.text_of_errors());
  const vm::Program& p = c.linked->program;
  const vm::Executable executable(p);
  const int lanes = kSanitized ? 32 : 256;
  auto narrow = picture_points<float>(lanes);
  auto wide = picture_points<double>(lanes);
  for (const vm::Descriptor& d : p.descriptors) {
    INFO(d.name);
    REQUIRE(d.emit.function);
    const Run batch = run(p, executable, *d.emit.function, narrow, lanes);
    const Run exact = run(p, executable, *d.emit.function, wide, lanes);
    int far = 0, different = 0;
    for (int i = 0; i < lanes; ++i) {
      bool near = true;
      for (std::size_t k = 0; k < batch.values.size(); ++k) {
        const double a = batch.values[k][std::size_t(i)], b = exact.values[k][std::size_t(i)];
        near = near && std::fabs(a - b) <= 1e-3 * (1 + std::fabs(b));
      }
      far += !near;
      if (i % 16) continue;
      auto one = alone(narrow, i);
      const Run single = run(p, executable, *d.emit.function, one, 1);
      for (std::size_t k = 0; k < batch.values.size(); ++k)
        different += !same_bits(single.values[k][0], batch.values[k][std::size_t(i)]);
    }
    CHECK(different == 0);
    // An edge that a point falls on is drawn by rounding.
    CHECK(far <= lanes / 64);
  }
}

/// Functions of the noises' and patterns' modules that are neither: constants and numbers that
/// those are made with, and the searches behind the cellular noises, whose distances have pictures.
constexpr std::string_view kNoPicture =
    " limited box_response fade widest coverage turn minkowski worley_ways worley_shifts "
    "worley_cell worley_border worley_border_shifts worley_nearest worley_nearest_squared "
    "worley_border_distance manhattan euclidean chebyshev ";

/// The names of the functions of those modules.
std::set<std::string> noises_and_patterns() {
  constexpr std::string_view kModules = " noise gabor seeds worley patterns ";
  const auto of = [&](std::string_view module) {
    return kModules.find(" " + std::string(module) + " ") != kModules.npos;
  };
  std::set<std::string> names;
  for (const vm::Builtin& row : stdlib::builtins()) {
    const std::string_view call = row.signature.substr(0, row.signature.find('('));
    if (row.lobe < 0 && of(row.module)) names.emplace(call.substr(call.rfind(' ') + 1));
  }
  for (const vm::Library::Module& module : stdlib::modules()) {
    if (!of(module.name)) continue;
    for (const vm::Library::Item& item : module.items) names.emplace(item.name);
  }
  return names;
}

TEST_CASE("every noise and pattern has its picture in the manual, and what has none is on a list") {
  const Compiled c = compile(script());
  REQUIRE_MESSAGE(c.linked, c.text_of_errors());
  const std::set<std::string> names = noises_and_patterns();
  std::set<std::string> pictured;
  for (const vm::Descriptor& d : c.linked->program.descriptors) {
    CHECK_MESSAGE(names.count(d.name) == 1, d.name << " is no noise and no pattern");
    const auto file = mms::source_dir() / "docs/images/library" / (d.name + ".png");
    CHECK_MESSAGE(std::filesystem::exists(file), file.string() << ": `./run figures` makes it");
    pictured.insert(d.name);
  }
  for (const std::string& name : names) {
    const bool none = kNoPicture.find(" " + name + " ") != kNoPicture.npos;
    CHECK_MESSAGE((pictured.count(name) == 1) != none,
                  name << (none ? " has a picture" : " has no surface in library.mms"));
  }
}

}  // namespace
}  // namespace mms::golden
