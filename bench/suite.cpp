// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

#include "api/library.h"
#include "lang/parser.h"
#include "vm/verify.h"

namespace mms::bench {
namespace {

template <class F>
F find(const Named<F>* twins, const char* name) {
  for (; twins->name; ++twins)
    if (!std::strcmp(twins->name, name)) return twins->twin;
  return nullptr;
}

[[noreturn]] void fail(const std::string& why) {
  fmt::print(stderr, "error: {}\n", why);
  std::exit(1);
}

/// The machine input that each float of a Point goes to.
struct Column {
  vm::Variable variable;
  int components;
};
constexpr Column kColumns[] = {
    {vm::Variable::ObjectPosition, 3}, {vm::Variable::Uv, 2},
    {vm::Variable::Normal, 3},         {vm::Variable::View, 3},
    {vm::Variable::ObjectTangent, 3},  {vm::Variable::ObjectBitangent, 3},
    {vm::Variable::RgbRed, 8},         {vm::Variable::RgbGreen, 8}};
constexpr int kFloats = sizeof(Point<float>) / sizeof(float);
static_assert(kFloats == 33);

void unit(std::mt19937& random, float (&v)[3]) {
  std::normal_distribution<float> normal;
  float length = 0;
  for (float& x : v) x = normal(random), length += x * x;
  for (float& x : v) x /= std::sqrt(length);
}

}  // namespace

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"constant", "constant", 1e-7, 0, 0, 0},
      {"gradient", "gradient, 12 operations", 1e-6, 0, 0, 0},
      {"checker", "checker", 1e-6, 0, 0, 0},
      {"noise", "one 3D noise", 2e-6, 0, 73, 26},
      {"marble", "marble, fBm of 6 octaves", 2e-5, 0, 218, 69},
      {"marble_in_script", "marble, noise in script", 2e-5, 0, 0, 0},
      {"worley", "Worley, 27 cells", 2e-6, 0, 554, 199},
      {"mandelbrot", "Mandelbrot, 128 steps", 1e-6, 10, 126, 36},
      {"spectral", "spectral mix and absorption", 2e-6, 0, 0, 0},
      {"layered", "layered, Fresnel and fBm", 2e-5, 0, 184, 69},
      {"bump", "bump gradient of fBm", 2e-5, 0, 111, 40},
      {"wood", "wood, warped domain", 2e-4, 2, 0, 0},
  };
  return all;
}

Points::Points(int count) : singles(count), exact(count), columns_(std::size_t(count) * kFloats) {
  std::mt19937 random(20240601);
  std::uniform_real_distribution<float> unity(0, 1), around(-1, 1);
  for (int i = 0; i < count; ++i) {
    Point<float>& p = singles[i];
    for (float& x : p.position) x = around(random);
    for (float& x : p.uv) x = unity(random);
    unit(random, p.normal);
    unit(random, p.view);
    unit(random, p.tangent);
    unit(random, p.bitangent);
    for (float& x : p.red) x = unity(random);
    for (float& x : p.green) x = unity(random);
    const float* from = p.position;
    double* to = exact[i].position;
    for (int k = 0; k < kFloats; ++k) {
      to[k] = from[k];
      columns_[std::size_t(k) * count + i] = from[k];
    }
  }
}

Lanes Points::lanes() const {
  Lanes l;
  const float* next = columns_.data();
  const auto fill = [&](auto& pointers) {
    for (const float*& p : pointers) p = next, next += count();
  };
  fill(l.position), fill(l.uv), fill(l.normal), fill(l.view), fill(l.tangent), fill(l.bitangent);
  fill(l.red), fill(l.green);
  return l;
}

std::vector<vm::InputBatch<float>> Points::batches(int width) const {
  std::vector<vm::InputBatch<float>> all;
  for (int first = 0; first < count(); first += width) {
    vm::InputBatch<float>& batch = all.emplace_back(width);
    int k = 0;
    for (const Column& column : kColumns)
      for (int c = 0; c < column.components; ++c, ++k)
        for (int i = 0; i < width; ++i)
          batch.lanes(column.variable, c)[i] =
              columns_[std::size_t(k) * count() + (first + i) % count()];
  }
  return all;
}

std::string text_of(const std::string& name) {
  const std::string path = fmt::format("{}/bench/shaders/{}.mms", MMS_SOURCE_DIR, name);
  std::ifstream file(path);
  if (!file) fail("cannot read " + path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

vm::Program link_text(const std::string& text) {
  lang::Diagnostics diagnostics;
  const lang::Graph graph = lang::parse(lang::make_source("shader", text), diagnostics);
  auto linked = lang::link({&graph, 1}, api::standard_library(), {}, diagnostics);
  if (!linked) fail("a shader of the suite does not link");
  if (vm::verify(linked->program)) fail("a shader of the suite does not verify");
  return std::move(linked->program);
}

Shader load(const Row& row) {
  Shader s{&row, link_text(text_of(row.name)), nullptr, 0, {}, 0, {}, {}, {}, {}};
  s.executable = std::make_unique<vm::Executable>(s.program);
  if (s.program.descriptors.empty()) {
    s.function = s.program.exports.at(0).function;
    for (std::size_t k = 0; k < s.program.functions[s.function].results.size(); ++k)
      s.results.push_back(int(k));
  } else {
    const vm::Entry& shade = s.program.descriptors[0].shade;
    s.function = shade.function.value();
    for (const vm::ValueSource& g : shade.gradient) s.results.push_back(int(g.index));
  }
  for (const int k : s.results)
    s.numbers += vm::block_count(s.program.functions[s.function].results[k]);
  s.gcc = find(kGccTwins, row.name);
  s.clang = find(kClangTwins, row.name);
  s.oracle = find(kOracles, row.name);
  s.vector = find(kVectorTwins, row.name);
  return s;
}

void run_all(const Shader& shader, vm::Interpreter<float>& machine,
             const std::vector<vm::InputBatch<float>>& batches, int per_batch) {
  for (const vm::InputBatch<float>& batch : batches)
    machine.run(*shader.executable, shader.function, batch, per_batch);
}

namespace {

/// Compares one point's numbers with the oracle's.
void compare(const Shader& s, const double* expected, const float* found, Error& error) {
  double worst = 0;
  for (int k = 0; k < s.numbers; ++k) {
    const double difference = std::fabs(found[k] - expected[k]);
    worst = std::max(worst, std::isnan(difference) ? HUGE_VAL : difference);
  }
  if (worst > s.row->bound)
    ++error.beyond;
  else
    error.largest = std::max(error.largest, worst);
}

/// Our numbers of all points, one point's after another's.
std::vector<float> our_numbers(const Shader& s, const Points& points) {
  const int width = s.executable->width();
  vm::Interpreter<float> machine(width);
  std::vector<float> numbers(std::size_t(points.count()) * s.numbers);
  int first = 0;
  for (const vm::InputBatch<float>& batch : points.batches(width)) {
    machine.run(*s.executable, s.function, batch, width);
    int k = 0;
    for (const int result : s.results) {
      const vm::SlotType type = s.program.functions[s.function].results[result];
      for (int c = 0; c < vm::block_count(type); ++c, ++k)
        for (int i = 0; i < width && first + i < points.count(); ++i)
          numbers[std::size_t(first + i) * s.numbers + k] = machine.result(result, c)[i];
    }
    first += width;
  }
  return numbers;
}

}  // namespace

Check check(const Shader& s, const Points& points) {
  const int n = points.count();
  const std::vector<float> ours = our_numbers(s, points);
  std::vector<float> vector(std::size_t(n) * 8);
  float* out[8];
  for (int k = 0; k < 8; ++k) out[k] = vector.data() + std::size_t(k) * n;
  if (s.vector) s.vector(points.lanes(), out, n);
  Check c{};
  for (int i = 0; i < n; ++i) {
    double expected[8];
    float scalar[8], lane[8];
    s.oracle(points.exact[i], expected);
    compare(s, expected, &ours[std::size_t(i) * s.numbers], c.ours);
    for (const Twin<float> twin : {s.gcc, s.clang})
      if (twin) twin(points.singles[i], scalar), compare(s, expected, scalar, c.scalar);
    for (int k = 0; k < s.numbers; ++k) lane[k] = out[k][i];
    if (s.vector) compare(s, expected, lane, c.vector);
  }
  const int allowed = n * s.row->stepped / 1000;
  c.good = c.ours.beyond <= allowed && c.scalar.beyond <= 2 * allowed && c.vector.beyond <= allowed;
  return c;
}

}  // namespace mms::bench
