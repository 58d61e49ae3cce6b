// SPDX-License-Identifier: Apache-2.0
// Makes vm/pairs.def: which pairs of lowered instructions are worth an instruction of their own.
//
//     bench_mine_pairs > vm/pairs.def
//
// Over the scripts of examples/ and bench/shaders: again and again the pair that occurs most often
// joins the table, counted where no chosen pair has taken one of its halves, until the next would
// occur fewer than kLeastCount times.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "api/library.h"
#include "lang/parser.h"
#include "vm/fuse.h"

namespace {

using mms::vm::LoweredOp;
using mms::vm::Pair;

constexpr std::size_t kMostPairs = 64;
constexpr int kLeastCount = 2;

std::vector<mms::vm::Program> corpus() {
  std::vector<mms::vm::Program> programs;
  for (const char* folder : {"examples", "bench/shaders"})
    for (const auto& file :
         std::filesystem::directory_iterator(fmt::format("{}/{}", MMS_SOURCE_DIR, folder))) {
      if (file.path().extension() != ".mms") continue;
      const auto source = mms::api::read_source(file.path().string());
      if (!source) continue;
      mms::lang::Diagnostics diagnostics;
      const mms::lang::Graph graph = mms::lang::parse(*source, diagnostics);
      auto linked = mms::lang::link({&graph, 1}, mms::api::standard_library(), {}, diagnostics);
      if (linked) programs.push_back(std::move(linked->program));
    }
  return programs;
}

struct Count {
  Pair pair;
  int fused = 0, possible = 0;
};

/// How often each pair occurs: fused, where `chosen` has it, or not.
std::vector<Count> count(const std::vector<mms::vm::Program>& programs,
                         const std::vector<Pair>& chosen) {
  std::vector<Count> counts;
  const auto pair_of = [&](const Pair& pair) -> std::optional<LoweredOp> {
    auto at =
        std::find_if(counts.begin(), counts.end(), [&](const Count& c) { return c.pair == pair; });
    if (at == counts.end()) at = counts.insert(counts.end(), {pair});
    const bool taken = std::find(chosen.begin(), chosen.end(), pair) != chosen.end();
    ++(taken ? at->fused : at->possible);
    return taken ? std::optional(LoweredOp::Copy) : std::nullopt;  // any that is no kernel
  };
  for (const mms::vm::Program& p : programs) mms::vm::lower(p, pair_of);
  return counts;
}

}  // namespace

int main() {
  const std::vector<mms::vm::Program> programs = corpus();
  std::vector<Pair> chosen;
  while (chosen.size() < kMostPairs) {
    const std::vector<Count> counts = count(programs, chosen);
    const auto best =
        std::max_element(counts.begin(), counts.end(),
                         [](const Count& a, const Count& b) { return a.possible < b.possible; });
    if (best == counts.end() || best->possible < kLeastCount) break;
    chosen.push_back(best->pair);
  }
  fmt::print(
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// Made by bench/mine_pairs.cpp from the scripts of examples/ and bench/shaders.\n"
      "//\n"
      "// PAIR(first, second, position, constants): `second`, whose operand `position` is the "
      "result\n"
      "// of `first`; bit k of `constants` says that operand k of all the others is a constant.\n"
      "// clang-format off\n");
  for (const Count& c : count(programs, chosen))
    if (c.fused > 0)
      fmt::print("PAIR({}, {}, {}, {})  // {}\n", name(c.pair.first), name(c.pair.second),
                 c.pair.position, c.pair.constants, c.fused);
  fmt::print("// clang-format on\n");
}
