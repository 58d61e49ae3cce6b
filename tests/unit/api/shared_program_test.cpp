// SPDX-License-Identifier: Apache-2.0
// Eight threads share one program, and eight link programs of their own: for the thread sanitizer,
// and for equal bits without it.
#include <atomic>
#include <cstring>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "api/samples.h"
#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"

namespace mms::api {
namespace {

constexpr int kThreads = 8;
constexpr const char* kScript =
    "import \"noise\" as n;\n"
    "surface s\n"
    "  p = 3.0 * $object_position;\n"
    "  height = 0.1 * n::fbm(p, 5) + 0.05 * length(worley_pair(p));\n"
    "  bsdf = mix(matte(rgb(0.5 + 0.5 * perlin(p), 0.2, 0.1)), gold(0.2), 0.3);\n"
    "end\n"
    "real steps(real x, integer k) = select x, if k >= 40 or x > 4.0; steps(x * x + 0.3, k + 1)\n"
    "  otherwise; end;\n"
    "const real divergent = steps($position[0], 0);\n";

/// Every result of every entry and export, as bits.
std::vector<float> values(const vm::Program& p, const vm::Executable& exe, int width) {
  vm::InputBatch<float> in(width);
  vm::Interpreter<float> machine(width);
  fill_defaults(in);
  std::vector<std::uint32_t> functions;
  for (const vm::Descriptor& d : p.descriptors)
    for (const vm::Entry* e : {&d.shade, &d.pass, &d.emit, &d.displace})
      if (e->function) functions.push_back(*e->function);
  for (const vm::Export& e : p.exports) functions.push_back(e.function);
  const Samples samples{kSanitized ? 96 : 960, {}};
  std::vector<float> all;
  for (std::uint32_t f : functions)
    for (int first = 0; first < samples.count; first += width) {
      const int lanes = std::min(width, samples.count - first);
      fill_samples(in, samples, first, lanes);
      machine.run(exe, f, in, lanes);
      const auto& types = p.functions[f].results;
      for (std::size_t k = 0; k < types.size(); ++k)
        for (int c = 0; c < vm::block_count(types[k]); ++c)
          if (types[k] == vm::SlotType::Real || types[k] == vm::SlotType::Spectrum)
            all.insert(all.end(), machine.result(int(k), c), machine.result(int(k), c) + lanes);
    }
  return all;
}

template <class Work>
void in_threads(Work work) {
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) threads.emplace_back(work, t);
  for (std::thread& t : threads) t.join();
}

TEST_CASE("eight threads share one program and get the same bits") {
  const auto c = golden::compile(std::string(kScript));
  INFO(c.text_of_errors());
  REQUIRE(c.linked);
  const vm::Program& p = c.linked->program;
  const vm::Executable exe(p);
  const std::vector<float> expected = values(p, exe, 96);
  REQUIRE(expected.size() > 1000);
  std::atomic<int> wrong{0};
  in_threads([&](int) {
    for (int round = 0; round < (kSanitized ? 2 : 10); ++round) {
      const std::vector<float> found = values(p, exe, 96);
      wrong += found.size() != expected.size() ||
               std::memcmp(found.data(), expected.data(), found.size() * sizeof(float)) != 0;
    }
  });
  CHECK(wrong == 0);
}

TEST_CASE("eight threads parse, link and lower at the same time") {
  std::atomic<int> wrong{0};
  const auto one = golden::compile(std::string(kScript));
  REQUIRE(one.linked);
  const std::string expected = vm::disassemble(one.linked->program);
  in_threads([&](int) {
    const auto c = golden::compile(std::string(kScript));
    wrong += !c.linked || vm::disassemble(c.linked->program) != expected;
    if (c.linked) vm::Executable{c.linked->program};
  });
  CHECK(wrong == 0);
}

}  // namespace
}  // namespace mms::api
