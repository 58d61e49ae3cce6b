// SPDX-License-Identifier: Apache-2.0
// What evaluating and sampling each scattering model costs, next to how far its floats are from its
// doubles: prints the table and writes its part of docs/performance.md.
//
//   bench_materials [--no-document]
#include <fmt/core.h>

#include <cmath>
#include <random>
#include <string_view>

#include "api/outputs.h"
#include "bench/document.h"
#include "bench/measure.h"
#include "bench/suite.h"
#include "materials/bsdf.h"
#include "materials/table.h"

namespace mms::bench {
namespace {

using materials::Bsdf;
using materials::Mode;

constexpr int kHits = 1024, kRounds = 31;

/// One hit: what a path brings to it, in either width.
template <class R>
struct Hit {
  Vec3<R> wo, wi;
  R u[3];
};

/// Hits on a material: half of their `wi` are its own samples, half are even over the sphere.
std::vector<Hit<double>> hits_of(const Bsdf<double>& bsdf) {
  std::mt19937 random(5);
  const auto number = [&] { return double(random() >> 8) * 0x1p-24; };  // a float, too
  const auto narrow = [](Vec3d v) { return Vec3d{float(v.x), float(v.y), float(v.z)}; };
  std::vector<Hit<double>> hits;
  for (int i = 0; i < kHits; ++i) {
    Hit<double> h{narrow(square_to_cosine_hemisphere(number(), number())),
                  narrow(square_to_sphere(number(), number())),
                  {number(), number(), number()}};
    const auto s = bsdf.sample(h.wo, number(), number(), number(), Mode::Radiance);
    if (i % 2 && s && !s->specular) h.wi = narrow(s->wi);
    hits.push_back(h);
  }
  return hits;
}

std::vector<Hit<float>> narrow(const std::vector<Hit<double>>& hits) {
  const auto of = [](Vec3d v) { return Vec3f{float(v.x), float(v.y), float(v.z)}; };
  std::vector<Hit<float>> out;
  for (const Hit<double>& h : hits)
    out.push_back({of(h.wo), of(h.wi), {float(h.u[0]), float(h.u[1]), float(h.u[2])}});
  return out;
}

/// |float - double| / double over the hits where f is not 0, in units of 2^-24.
Series errors(const Bsdf<float>& narrow, const Bsdf<double>& exact,
              const std::vector<Hit<double>>& hits, const std::vector<Hit<float>>& narrow_hits) {
  Series all;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double f = exact.eval(hits[i].wo, hits[i].wi, Mode::Radiance)[0];
    const double g = narrow.eval(narrow_hits[i].wo, narrow_hits[i].wi, Mode::Radiance)[0];
    if (f > 1e-30) all.push_back(std::abs(g - f) / f * 0x1p24);
  }
  return all;
}

/// Keeps what is computed from being thrown away, and where the next call needs it, in order.
volatile float sink;

struct Costs {
  double batch[3], single[3];  ///< evaluate, pdf, sample
};

Costs costs(const materials::Layout& layout, const std::vector<float>& numbers,
            const std::vector<Hit<float>>& hits) {
  const auto evaluate = [&](const Bsdf<float>& b, const Hit<float>& h) {
    return b.evaluate(h.wo, h.wi, Mode::Radiance).f[0];
  };
  const auto pdf = [&](const Bsdf<float>& b, const Hit<float>& h) {
    return b.pdf(h.wo, h.wi, Mode::Radiance)[0];
  };
  const auto sample = [&](const Bsdf<float>& b, const Hit<float>& h) {
    const auto s = b.sample(h.wo, h.u[0], h.u[1], h.u[2], Mode::Radiance);
    return s ? s->f[0] : 0.0f;
  };
  // Each hit with its own numbers, one after the other: throughput.
  std::vector<float> many;
  for (int i = 0; i < kHits; ++i) many.insert(many.end(), numbers.begin(), numbers.end());
  const auto batch = [&](const auto& call) {
    return [&, call] {
      float sum = 0;
      for (std::size_t i = 0; i < hits.size(); ++i)
        sum += call(Bsdf<float>(layout, many.data() + i * numbers.size()), hits[i]);
      sink = sum;
    };
  };
  // Each call waits for the result of the one before: latency.
  const auto single = [&](const auto& call) {
    return [&, call] {
      float last = 0;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        Hit<float> h = hits[i];
        h.wo.x += last * 1e-30f;
        last = call(Bsdf<float>(layout, numbers.data()), h);
      }
      sink = last;
    };
  };
  const auto series = interleave(
      {batch(evaluate), batch(pdf), batch(sample), single(evaluate), single(pdf), single(sample)},
      kHits, kRounds);
  Costs c{};
  for (int k = 0; k < 3; ++k) {
    c.batch[k] = median(series[k]);
    c.single[k] = median(series[3 + k]);
  }
  return c;
}

/// The row of a material's example, or nothing for phase functions.
std::string row_of(const vm::Builtin& row) {
  if (materials::traits(materials::Lobe(row.lobe)) & materials::PhaseFunction) return "";
  const vm::Program program = link_text(fmt::format("surface s bsdf = {}; end", row.example));
  const auto source = api::material_source(program.descriptors.at(0), vm::Output::Material);
  const materials::Layout layout(*source->layout);
  vm::InputBatch<double> in(vm::Executable(program).width());
  for (int c = 0; c < kWavelengths; ++c)
    in.lanes(vm::Variable::Wavelength, c)[0] = (400 + 50 * c) * 1e-9;
  const std::vector<double> numbers = api::material_numbers(program, *source, in);
  const std::vector<float> rounded(numbers.begin(), numbers.end());
  const std::vector<double> same(rounded.begin(), rounded.end());
  const Bsdf<double> exact(layout, same.data());
  const auto hits = hits_of(exact);
  const auto narrow_hits = narrow(hits);
  const Series e = errors(Bsdf<float>(layout, rounded.data()), exact, hits, narrow_hits);
  const Costs c = costs(layout, rounded, narrow_hits);
  const std::string error =
      e.empty() ? "| | |" : fmt::format("| {:.1f} | {:.0f} |", median(e), quantile(e, 0.999));
  return fmt::format("| `{}` | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} {}\n",
                     row.example, c.batch[0], c.batch[1], c.batch[2], c.single[0], c.single[1],
                     c.single[2], error);
}

std::string document() {
  std::string table =
      "| material | evaluate | pdf | sample | evaluate alone | pdf alone | sample alone | error, "
      "median | error, 999 of 1000 |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const vm::Builtin& row : materials::rows()) table += row_of(row);
  return fmt::format(
      "## Materials, ns a hit\n\nAll eight wavelengths of a hit in float, the choice among parts "
      "included: the median of {} rounds\nover {} hits, half of whose directions are the model's "
      "own "
      "samples. First as the renderer calls them, hit after\nhit with numbers of its own; then "
      "`alone`, where each call waits for the one before. `error` is how far f in float is\nfrom f "
      "in double at the same numbers, in units of 2^-24 of it; models that are ideally specular "
      "have "
      "no f. `./run bench`, or\n`bench_materials` alone.\n\n{}",
      kRounds, kHits, table);
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  return mms::bench::part_main(count, arguments, "materials", mms::bench::document);
}
