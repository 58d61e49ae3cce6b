// SPDX-License-Identifier: Apache-2.0
// What light transport costs: scripts against C++, quasi-Monte Carlo against random, samples a
// second and time to an error. Writes its parts of docs/performance.md; names of parts as arguments
// choose among them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/document.h"
#include "bench/measure.h"
#include "bench/native_marble.h"
#include "bench/setting.h"
#include "materials/colour.h"
#include "renderer/render.h"
#include "renderer/scene.h"

namespace mms::bench {
namespace {

using renderer::Generator;
using renderer::Rendered;

double mean_luminance(const renderer::Film& film) {
  double sum = 0;
  for (const auto& xyz : film.xyz) sum += xyz[1];
  return sum / double(film.xyz.size());
}

// Scripts against C++

std::string overhead() {
  constexpr int kSide = 192, kSamples = 8, kRounds = 9;
  const std::string sphere = *renderer::builtin_scene_text("sphere");
  std::string plain = sphere;
  const std::string test = "\"test\": true";
  plain.replace(plain.find(test), test.size(), "\"surface\": \"grey59\"");
  const std::string unused = "surface s\n bsdf = matte(0.591);\nend\n";
  const Setting constant(unused, sphere), described(unused, plain), marble(kMarble, sphere);
  const auto seconds = [&](const Setting& s) {
    return s.render(kSide, kSamples, 1).report.seconds;
  };
  const auto natively = [](auto run) {
    native_marble = true;
    auto r = run();
    native_marble = false;
    return r;
  };
  const renderer::Film a = marble.render(48, 8, 1).film;
  const renderer::Film b = natively([&] { return marble.render(48, 8, 1).film; });
  // The last bit of a colour may end a path at a roulette; else the pictures are the same.
  std::size_t others = 0;
  for (std::size_t i = 0; i < a.xyz.size(); ++i)
    others += std::abs(a.xyz[i][1] - b.xyz[i][1]) > 1e-4 * (1 + a.xyz[i][1]);
  const double share = double(others) / double(a.xyz.size());
  if (share > 0.01) give_up(fmt::format("the marble of C++ is another at {} of pixels", share));
  Series constants, marbles;
  for (int r = 0; r < kRounds; ++r) {
    constants.push_back(seconds(constant) / seconds(described));
    const double script = seconds(marble);
    marbles.push_back(script / natively([&] { return seconds(marble); }));
  }
  return fmt::format(
      "## Scripts against C++ in a render\n\n"
      "Time of a whole render of the scene `sphere`, {0}x{0} pixels of {1} samples, one thread: "
      "the "
      "script's over\nthat of the same material in C++, in turn, {2} rounds: median and quartiles. "
      "Constant: `matte(0.591)`\nagainst a material of the scene, for which no script runs. "
      "Marble: "
      "six octaves of fBm; the twin (`g++ -O3\n-march=native`, scalar, the suite's) stands in for "
      "the machine on the same inputs. {3:.1f}% of pixels\ndiffer: a last bit ended a path.\n\n"
      "| material | script over C++ |\n|---|---|\n| constant | {4} |\n| marble | {5} |\n",
      kSide, kSamples, kRounds, 100 * share, quartiles(constants, "{:.3f}"),
      quartiles(marbles, "{:.3f}"));
}

// Quasi-Monte Carlo against random

/// Root mean squares over pixels of the spread over seeds, of their luminance and of red, green and
/// blue together, and seconds.
struct Spread {
  double error = 0, colour = 0, seconds = 0;
};

Spread spread(const Setting& s, int samples, Generator generator) {
  constexpr int kSide = 32, kSeeds = 8;
  constexpr int kNumbers = 4;  // of a pixel: luminance, red, green, blue
  std::vector<double> sum(kSide * kSide * kNumbers), squares(sum.size());
  Spread out;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto [seconds, r] =
        charged([&] { return s.render(kSide, samples, 1, std::uint64_t(seed), generator); });
    out.seconds += seconds / kSeeds;
    for (std::size_t i = 0; i < r.film.xyz.size(); ++i) {
      const auto& [x, y, z] = r.film.xyz[i];
      const Vec3d rgb = materials::linear_srgb_of_xyz({x, y, z});
      const double numbers[kNumbers] = {y, rgb.x, rgb.y, rgb.z};
      for (int k = 0; k < kNumbers; ++k) {
        sum[i * kNumbers + k] += numbers[k];
        squares[i * kNumbers + k] += numbers[k] * numbers[k];
      }
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    (i % kNumbers == 0 ? out.error : out.colour) +=
        (squares[i] - sum[i] * sum[i] / kSeeds) / (kSeeds - 1);
  out.error = std::sqrt(out.error / (kSide * kSide));
  out.colour = std::sqrt(out.colour / (3 * kSide * kSide));
  return out;
}

std::string sampling() {
  constexpr int kCounts[] = {4, 16, 64};
  struct Case {
    const char *scene, *material, *script;
  };
  constexpr Case kCases[] = {
      {"sphere", "matte", "surface s\n bsdf = matte(0.5);\nend\n"},
      {"sphere", "rough metal", "surface s\n bsdf = conductor(0.2, 3.4, 0.4);\nend\n"},
      {"furnace", "glossy", "surface s\n bsdf = glossy(0.8, 100.0);\nend\n"},
      {"cornell", "matte", "surface s\n bsdf = matte(0.5);\nend\n"},
      {"shaderball", "matte", "surface s\n bsdf = matte(0.5);\nend\n"},
      {"backlit", "translucent", "surface s\n bsdf = translucent(0.8);\nend\n"},
      {"prism", "glass",
       "surface s\n bsdf = dielectric(1.5 + 4e-15 / ($wavelength * $wavelength));\nend\n"},
      {"grid", "glossy", "surface s\n bsdf = glossy(0.8, 100.0);\nend\n"},
  };
  std::string text =
      "## Quasi-Monte Carlo against random\n\n"
      "Root mean square of the spread of pixels' luminance over 8 seeds, 32x32 pixels, box filter, "
      "one thread:\nthe Owen-scrambled (1,4)-sequence and plain random numbers. Slopes are of log "
      "error over log samples from 4\nto 64. Time at equal error: what random would take to come "
      "to "
      "the error of the sequence at 64 samples,\nby its slope of -1/2, over what the sequence "
      "took. Colour: the error at 16 samples of red, green and blue\ntogether over that of "
      "luminance, which is what a render without colour would have; all but `cornell` and `prism`\n"
      "are grey.\n\n| scene, material | error at 4 | at 16 | at 64 | random at 64 | slope | slope, "
      "random | time at equal error | colour |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Case& c : kCases) {
    const Setting s(c.script, c.scene);
    std::vector<Spread> ours, random;
    for (int n : kCounts) {
      ours.push_back(spread(s, n, Generator::Niederreiter));
      random.push_back(spread(s, n, Generator::Random));
    }
    const auto slope = [](const std::vector<Spread>& v) {
      return std::log(v.back().error / v.front().error) / std::log(64.0 / 4);
    };
    const double gain = std::pow(random.back().error / ours.back().error, 2) *
                        random.back().seconds / ours.back().seconds;
    text += fmt::format(
        "| {}, {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} | {:.3f} |\n",
        c.scene, c.material, ours[0].error, ours[1].error, ours[2].error, random[2].error,
        slope(ours), slope(random), gain, ours[1].colour / ours[1].error);
  }
  return text;
}

std::string semi_transparency() {
  constexpr int kSamples = 64;
  const std::string script = example("figures/stained_glass.mms"),
                    scene = example("figures/stained_glass.json");
  const Spread free = spread({script, scene, "free"}, kSamples, Generator::Niederreiter);
  const Spread ordinary = spread({script, scene, "ordinary"}, kSamples, Generator::Niederreiter);
  const double gain = std::pow(ordinary.error / free.error, 2);
  return fmt::format(
      "## Semi-transparency that makes no vertex\n\n"
      "Thesis Figure 6.2, `examples/figures/stained_glass.mms`: the window as what rays pass on "
      "their "
      "way, and as a\nmaterial that lets light straight through. Spread over 8 seeds as above, {} "
      "samples a pixel.\n\n"
      "| window | error | seconds |\n|---|---|---|\n| on the way | {:.4f} | {:.2f} |\n"
      "| a vertex | {:.4f} | {:.2f} |\n\nVariance is {:.0f} times less at equal samples, {:.0f} "
      "times less at equal time.\n",
      kSamples, free.error, free.seconds, ordinary.error, ordinary.seconds, gain,
      gain * ordinary.seconds / free.seconds);
}

// Samples a second and time to an error

/// Samples a pixel until the root mean square error is `target`, if it falls like 1 / sqrt(n).
double samples_to(const Rendered& r, double target) {
  return r.report.samples * std::pow(r.report.rmse / target, 2);
}

std::string speed() {
  constexpr int kSide = 512, kRounds = 5;
  std::string text = fmt::format(
      "## Samples a second, time to an error\n\n"
      "Scene `sphere`, 512x512 pixels of 2 samples, on one thread and on two in turn: medians of "
      "{} rounds, of the ratio\nwith quartiles. Time to 1%: until the root mean square over pixels "
      "of the standard error is a hundredth of the mean\nluminance, from the error of 64 samples "
      "at 128x128 and a fall of 1 / sqrt(n): an upper bound, since the sequence falls\nfaster. One "
      "thread by the processor's seconds, two and the ratio by the clock, at a load average of {}. "
      "Fill: mean\nlanes of a run of the machine over the width of a batch.\n\n"
      "| material | million samples a second, 1 thread | 2 threads | ratio | samples a pixel to 1% "
      "| seconds, 1 thread | 2 threads | fill |\n|---|---|---|---|---|---|---|---|\n",
      kRounds, load());
  for (const Material& m : materials()) {
    const Setting s(m.script, "sphere");
    Series rates, both_rates, gains;
    double fill = 0, runs = 0;
    for (int r = 0; r < kRounds; ++r) {
      const auto [seconds, one] = charged([&] { return s.render(kSide, 2, 1); });
      const Rendered two = s.render(kSide, 2, 2);
      rates.push_back(double(one.report.paths) / seconds);
      both_rates.push_back(double(two.report.paths) / two.report.seconds);
      gains.push_back(one.report.seconds / two.report.seconds);
      fill = one.report.batch_fill;
      runs = double(one.report.script_runs);
    }
    const double rate = median(rates), both = median(both_rates);
    const Rendered fine = s.render(128, 64, 2);
    const double n = samples_to(fine, 0.01 * mean_luminance(fine.film));
    text += fmt::format("| {} | {:.2f} | {:.2f} | {} | {:.0f} | {:.1f} | {:.1f} | {} |\n", m.name,
                        rate / 1e6, both / 1e6, quartiles(gains, "{:.2f}"), n,
                        n * kSide * kSide / rate, n * kSide * kSide / both,
                        runs > 0 ? fmt::format("{:.0f}%", 100 * fill) : "no runs");
  }
  return text;
}

/// From the text of a script to a picture of one sample a pixel.
Series first_pictures(int side) {
  Series all;
  for (int i = 0; i < 9; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    Setting(example("marble.mms"), "sphere").render(side, 1, 2);
    all.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return all;
}

std::string first() {
  return fmt::format(
      "## First picture\n\nFrom the text of `marble.mms` to a picture of `sphere`, two threads, "
      "one "
      "sample a pixel, seconds: median and\nquartiles of 9. For 512x512 pixels `mms render "
      "--watch` "
      "shows a\nsixteenth of them first: {}. All of them: {}. Load average {}.\n",
      quartiles(first_pictures(128), "{:.3f}"), quartiles(first_pictures(512), "{:.3f}"), load());
}

int run(int argc, char** argv) {
  struct Part {
    std::string name;
    std::function<std::string()> make;
  };
  const Part parts[] = {{"overhead", overhead},
                        {"sampling", sampling},
                        {"semi-transparency", semi_transparency},
                        {"speed", speed},
                        {"first", first}};
  bool good = true;
  for (const Part& p : parts) {
    if (argc > 1 && std::find(argv + 1, argv + argc, p.name) == argv + argc) continue;
    const std::string text = p.make();
    fmt::print("{}\n", text);
    good &= write_part("transport-" + p.name, text);
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace mms::bench

int main(int argc, char** argv) { return mms::bench::run(argc, argv); }
