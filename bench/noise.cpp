// SPDX-License-Identifier: Apache-2.0
// What every noise costs in 1 to 4 dimensions, through the machine, next to native twins of Perlin
// and Worley noise: prints the tables and writes their part of docs/performance.md.
//
//   bench_noise [--no-document]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "bench/document.h"
#include "bench/measure.h"
#include "bench/suite.h"

namespace mms::bench {
namespace {

constexpr int kPoints = 1024, kRounds = 31;

/// A call, where `{p}` is the place, `{period}` periods, `{a}` and `{periods}` the same as arrays
/// always, `{f}` a frequency, `{second}` orders of derivatives; and how many dimensions it has:
/// bit n - 1 for n.
struct Call {
  const char* title;
  const char* text;
  unsigned dimensions = 15;
};
constexpr Call kCalls[] = {
    {"`hash`", "hash({p})"},
    {"`hash`, seed", "hash({p}, 7)"},
    {"`cellnoise`", "cellnoise({p})"},
    {"`cellnoise`, seed and period", "cellnoise({p}, 7, {period})"},
    {"`perlin`", "perlin({p})"},
    {"`perlin`, seed and period", "perlin({p}, 7, {period})"},
    {"`perlin_gradient`", "perlin_gradient({p})"},
    {"`perlin_vector`", "perlin_vector({p})", 14},
    {"`perlin_derivative`, second", "perlin_derivative({p}{second})"},
    {"`valuenoise`", "valuenoise({p})"},
    {"`valuenoise`, seed and period", "valuenoise({p}, 7, {period})"},
    {"`valuenoise_gradient`", "valuenoise_gradient({p})"},
    {"`simplex`", "simplex({p})"},
    {"`simplex`, seed and period", "simplex({p}, 7, {period})"},
    {"`simplex_gradient`", "simplex_gradient({p})"},
    {"`simplex_vector`", "simplex_vector({p})", 14},
    {"`worley`, 9 or 27 cells", "worley({p})", 6},
    {"`voronoi`, the same", "voronoi({p})", 6},
    {"`worley_pair`, 9 or 27 cells", "worley_pair({p})", 6},
    {"`worley_distances`: F1, F2, F3", "worley_distances({a})"},
    {"the same by Manhattan", "worley_distances({a}, 0, manhattan)"},
    {"the same by Minkowski, 3", "worley_distances({a}, 0, 3.0)"},
    {"`worley_squared`", "worley_squared({a})"},
    {"`worley_edge`", "worley_edge({a})"},
    {"`worley_id`", "worley_id({a})"},
    {"`gabor`", "gabor({a}, {f})"},
    {"`gabor`, filtered", "gabor({a}, {f}, 0, 0.1 * {f})"},
    {"`gabor_isotropic`", "gabor_isotropic({a}, 2.0)"},
    {"`fbm`, 6 octaves", "fbm({a}, 6)", 14},
    {"`fbm_tiled`, 6 octaves", "fbm_tiled(#perlin, {a}, {periods}, 6)", 14},
    {"`turbulence`, 6 octaves", "turbulence({a}, 6)", 14},
    {"`ridged`, 6 octaves", "ridged({a}, 6)", 14},
    {"`multifractal`, 6 octaves", "multifractal(#perlin, {a}, 6)", 14},
    {"`hetero_terrain`, 6 octaves", "hetero_terrain(#perlin, {a}, 6)", 14},
    {"`ridged_multifractal`, 6 octaves", "ridged_multifractal(#perlin, {a}, 6)", 14},
    {"`domain_warp`, twice", "domain_warp(#perlin, {a}, 0.8, 2)", 14},
    {"`curl`", "curl(#perlin, {a})", 6},
    {"`flow`, 6 octaves", "flow(#perlin, {a}, 6)", 14},
};

/// The first n of `parts` as an array.
std::string array_of(const char* const (&parts)[4], int n) {
  std::string text = "[";
  for (int k = 0; k < n; ++k) text += fmt::format("{}{}", k ? ", " : "", parts[k]);
  return text + "]";
}

std::string text_of(const Call& call, int n) {
  const std::string places = array_of(
      {"4 * $object_position.x", "4 * $object_position.y", "4 * $object_position.z", "4 * $uv.x"},
      n);
  const std::string periods = array_of({"6", "9", "3", "12"}, n);
  const auto scalar = [](const std::string& array) { return array.substr(1, array.size() - 2); };
  std::string text = call.text;
  const auto put = [&](std::string_view name, const std::string& with) {
    for (std::size_t at; (at = text.find(name)) != text.npos;) text.replace(at, name.size(), with);
  };
  put("{p}", n == 1 ? scalar(places) : places);
  put("{period}", n == 1 ? scalar(periods) : periods);
  put("{a}", places);
  put("{periods}", periods);
  put("{second}", std::string(", 2, 0, 0, 0").substr(0, std::size_t(3 * n)));
  put("{f}", array_of({"2", "1", "0", "1"}, n));
  return "const value = " + text + ";";
}

std::string number(double ns) {
  return ns < 10 ? fmt::format("{:.2f}", ns) : fmt::format("{:.1f}", ns);
}

/// The median of ns a point.
double measured(const std::string& text, const Points& points) {
  const vm::Program program = link_text(text);
  const vm::Executable executable(program);
  const int width = executable.width();
  const auto batches = points.batches(width);
  vm::Interpreter<float> machine(width);
  const auto all = [&] {
    for (const auto& batch : batches)
      machine.run(executable, program.exports.at(0).function, batch, width);
  };
  return median(interleave({all}, int(batches.size()) * width, kRounds)[0]);
}

std::string noise_table(const Points& points) {
  std::string table = "| noise | 1 | 2 | 3 | 4 dimensions |\n|---|---|---|---|---|\n";
  for (const Call& call : kCalls) {
    table += fmt::format("| {} |", call.title);
    for (int n = 1; n <= 4; ++n)
      table += call.dimensions >> (n - 1) & 1
                   ? fmt::format(" {} |", number(measured(text_of(call, n), points)))
                   : "  |";
    table += "\n";
  }
  return table;
}

/// Perlin and Worley noise of three dimensions next to native ones.
std::string twin_table(const Points& points) {
  std::string table =
      "| noise | ours | scalar, the better of g++ and clang++ | AVX2 by hand | scalar / ours | "
      "ours / "
      "by hand |\n|---|---|---|---|---|---|\n";
  for (const Row& row : rows()) {
    if (std::strcmp(row.name, "noise") != 0 && std::strcmp(row.name, "worley") != 0) continue;
    const Shader s = load(row);
    const int width = s.executable->width();
    const auto batches = points.batches(width);
    vm::Interpreter<float> machine(width);
    std::vector<float> out(std::size_t(points.count()) * 8);
    float* columns[8];
    for (int k = 0; k < 8; ++k) columns[k] = out.data() + std::size_t(k) * points.count();
    const Lanes lanes = points.lanes();
    const auto scalar = [&](Twin<float> twin) {
      return [&points, &out, twin] {
        for (int i = 0; i < points.count(); ++i) twin(points.singles[i], &out[std::size_t(i) * 8]);
      };
    };
    if (!s.gcc || !s.vector) continue;
    const auto series = interleave({[&] { run_all(s, machine, batches, width); },
                                    [&] { s.vector(lanes, columns, points.count()); },
                                    scalar(s.gcc), scalar(s.clang ? s.clang : s.gcc)},
                                   points.count(), kRounds);
    const Series& better = median(series[3]) < median(series[2]) ? series[3] : series[2];
    table +=
        fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} |\n", row.title,
                    number(median(series[0])), number(median(better)), number(median(series[1])),
                    median(ratios(better, series[0])), median(ratios(series[0], series[1])));
  }
  return table;
}

std::string document() {
  const Points points(kPoints);
  return fmt::format(
      "## Noise, ns a point\n\nA call of each, in a batch, through the machine: the median of {} "
      "rounds over {} random points\nin a cube of 8 cells a side. `./run bench`, or "
      "`bench_noise` alone.\n\n{}\nNext to the twins of the suite above, in turn in one "
      "process:\n\n{}",
      kRounds, kPoints, noise_table(points), twin_table(points));
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  return mms::bench::part_main(count, arguments, "noise", mms::bench::document);
}
