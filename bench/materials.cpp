// SPDX-License-Identifier: Apache-2.0
// What evaluating and sampling each scattering model costs, next to how far its floats are from its
// doubles: prints the table and writes its part of docs/performance.md; or prints that of the
// materials of surfaces that are named, as `coat(mirror(), matte(0.5))`, alone.
//
//   bench_materials [--no-document]
//   bench_materials MATERIAL...
#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <string_view>
#include <utility>

#include "api/outputs.h"
#include "bench/document.h"
#include "bench/measure.h"
#include "bench/suite.h"
#include "materials/bsdf.h"
#include "materials/phase.h"
#include "materials/table.h"

namespace mms::bench {
namespace {

using materials::Bsdf;
using materials::Mode;

/// A surface's scattering of radiance, with the face of a volume's. One choice is kept from hit to
/// hit, as an integrator does.
template <class R>
struct Surface {
  Bsdf<R> bsdf;

  Surface(const materials::Layout& layout, const R* params) : bsdf(layout, params) {}
  auto eval(Vec3<R> wo, Vec3<R> wi) const { return evaluate(wo, wi).f; }
  auto pdf(Vec3<R> wo, Vec3<R> wi) const { return bsdf.pdf(wo, wi, Mode::Radiance, choose(wo)); }
  auto evaluate(Vec3<R> wo, Vec3<R> wi) const {
    return bsdf.evaluate(wo, wi, Mode::Radiance, choose(wo));
  }
  auto sample(Vec3<R> wo, R u, R u1, R u2) const {
    return bsdf.sample(wo, u, u1, u2, Mode::Radiance, choose(wo));
  }

 private:
  const auto& choose(Vec3<R> wo) const {
    static typename Bsdf<R>::Choice kept;
    bsdf.choose(wo, kept);
    return kept;
  }
};

constexpr int kHits = 1024, kRounds = 61;

/// One hit: what a path brings to it, in either width.
template <class R>
struct Hit {
  Vec3<R> wo, wi;
  R u[3];
};

/// Hits on a material: half of their `wi` are its own samples, half are even over the sphere.
template <class Model>
std::vector<Hit<double>> hits_of(const Model& model) {
  std::mt19937 random(5);
  const auto number = [&] { return double(random() >> 8) * 0x1p-24; };  // a float, too
  const auto narrow = [](Vec3d v) { return Vec3d{float(v.x), float(v.y), float(v.z)}; };
  std::vector<Hit<double>> hits;
  for (int i = 0; i < kHits; ++i) {
    Hit<double> h{narrow(square_to_cosine_hemisphere(number(), number())),
                  narrow(square_to_sphere(number(), number())),
                  {number(), number(), number()}};
    const auto s = model.sample(h.wo, number(), number(), number());
    if (i % 2 && s && model.eval(h.wo, s->wi)[0] > 0) h.wi = narrow(s->wi);
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

/// |float - double| / double over the hits where f is not 0, in units of 2^-24; of what is ideally
/// specular, of the weights f |cos| of samples.
template <template <class> class Model>
Series errors(const Model<float>& narrow, const Model<double>& exact,
              const std::vector<Hit<double>>& hits, const std::vector<Hit<float>>& narrow_hits) {
  Series all;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double f = exact.eval(hits[i].wo, hits[i].wi)[0];
    const double g = narrow.eval(narrow_hits[i].wo, narrow_hits[i].wi)[0];
    if (f > 1e-30) all.push_back(std::abs(g - f) / f * 0x1p24);
  }
  if (!all.empty()) return all;
  const auto weight = [](const auto& model, const auto& h) {
    const auto s = model.sample(h.wo, h.u[0], h.u[1], h.u[2]);
    return s ? double(s->f[0]) * std::abs(double(s->wi.z)) : 0.0;
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double f = weight(exact, hits[i]), g = weight(narrow, narrow_hits[i]);
    if (f > 0 && g > 0) all.push_back(std::abs(g - f) / f * 0x1p24);
  }
  return all;
}

/// Keeps what is computed from being thrown away, and where the next call needs it, in order.
volatile float sink;

/// Variants of models that cost other than their examples.
constexpr const char* kVariants[] = {
    "microfacet(0.8, 0.4, 0.8)",
    "beckmann(0.8, 0.4, 0.8)",
    "dielectric(1.5, 0.4)",
    "dielectric(1.5, 0.4, anisotropy = 0.8)",
    "dielectric(1.45 + 1e-14 / ($wavelength * $wavelength), 0.4)",
    "dielectric(1.45 + 1e-14 / ($wavelength * $wavelength), 0.4, anisotropy = 0.8)",
    "beckmann_dielectric(1.5, 0.4, anisotropy = 0.8)",
    "film_conductor(2.5, 3.0, 1.5, 300nm, $wavelength, 0.3)",
    "film_dielectric(1.5, 1.38, 600nm, $wavelength, 0.2)",
    "film_dielectric(1.5, 1.38, 600nm, $wavelength, 0.4, anisotropy = 0.8)",
    "film_mix(matte(0.5), microfacet(1, 0.3), 1.5, 1.38, 300nm, $wavelength)",
    "film_mix(matte(0.5), microfacet(1, 0.3, 0.8), 1.5, 1.38, 300nm, $wavelength)",
    "coat(conductor(0.2, 3.4, 0.3), matte(0.5))",
    "coat(mirror(), fresnel_mix(matte(0.5), glossy(1, 40.0)))",
    "coat(mirror(), microfacet(0.8, 0.4))",
    "coat(mirror(), microfacet(0.8, 0.4, 0.8))",
    "coat(mirror(), microfacet(0.8, 0.4), ior = 1.45 + 1e-14 / ($wavelength * $wavelength))",
    "coat(microfacet(1, 0.3), microfacet(0.8, 0.4))",
    "coat(mirror(), dielectric(1.5, 0.4))",
    "coat(mirror(), glossy_refraction(1.5, 1.0, 40.0, 40.0))",
    "coat(microfacet(1, 0.3), dielectric(1.5))",
    "coat(microfacet(1, 0.3), dielectric(1.5, 0.4))",
    "coat(microfacet(1, 0.3), dielectric(1.5, 0.4, anisotropy = 0.8))",
    "coat(mirror(), phong_glass(1.5, 40.0))",
    "film_mix(dielectric(1.5, 0.4), mirror(), 1.5, 1.38, 300nm, $wavelength)",
    "coat(mirror(), film_dielectric(1.5, 1.38, 300nm, $wavelength, 0.4))",
    "coat(microfacet(1, 0.3), microfacet(0.8, 0.4), ior = 1.45 + 1e-14 / ($wavelength * "
    "$wavelength))",
};

/// A material that a script made.
struct Made {
  materials::Layout layout;
  std::vector<float> numbers;
};

/// That of a surface, or a volume's, of that expression.
Made make(std::string_view text, bool volume) {
  const char* open = volume ? "volume v scattering = 1; phase = " : "surface s bsdf = ";
  const vm::Program program = link_text(fmt::format("{}{}; end", open, text));
  const auto source = api::material_source(program.descriptors.at(0), vm::Output::Material);
  vm::InputBatch<double> in(vm::Executable(program).width());
  for (int c = 0; c < kWavelengths; ++c)
    in.lanes(vm::Variable::Wavelength, c)[0] = (400 + 50 * c) * 1e-9;
  const std::vector<double> numbers = api::material_numbers(program, *source, in);
  return {materials::Layout(*source->layout), {numbers.begin(), numbers.end()}};
}

/// A material on its way to its row.
struct Row {
  std::string text;
  Series errors;
  std::vector<std::function<void()>> calls;  ///< evaluate, pdf, sample; then the same alone
};

template <template <class> class Model>
Row row_of(std::string_view text, const Made& made) {
  const std::vector<double> same(made.numbers.begin(), made.numbers.end());
  const Model<double> exact(made.layout, same.data());
  const auto hits = hits_of(exact);
  struct State {
    Made made;
    std::vector<Hit<float>> hits;
    std::vector<float> many;  ///< numbers of its own for each hit
  };
  const auto state = std::make_shared<State>(State{made, narrow(hits), {}});
  for (int i = 0; i < kHits; ++i)
    state->many.insert(state->many.end(), made.numbers.begin(), made.numbers.end());

  const auto evaluate = [](const Model<float>& m, const Hit<float>& h) {
    return m.evaluate(h.wo, h.wi).f[0];
  };
  const auto pdf = [](const Model<float>& m, const Hit<float>& h) { return m.pdf(h.wo, h.wi)[0]; };
  const auto sample = [](const Model<float>& m, const Hit<float>& h) {
    const auto s = m.sample(h.wo, h.u[0], h.u[1], h.u[2]);
    return s ? s->f[0] : 0.0f;
  };
  // Each hit with its own numbers, one after the other: throughput.
  const auto batch = [&](auto call) {
    return [state, call] {
      float sum = 0;
      const std::size_t stride = state->made.numbers.size();
      for (std::size_t i = 0; i < state->hits.size(); ++i)
        sum +=
            call(Model<float>(state->made.layout, state->many.data() + i * stride), state->hits[i]);
      sink = sum;
    };
  };
  // Each call waits for the result of the one before: latency.
  const auto single = [&](auto call) {
    return [state, call] {
      float last = 0;
      for (Hit<float> h : state->hits) {
        h.wo.x += last * 1e-30f;
        last = call(Model<float>(state->made.layout, state->made.numbers.data()), h);
      }
      sink = last;
    };
  };
  return {
      std::string(text),
      errors(Model<float>(made.layout, made.numbers.data()), exact, hits, state->hits),
      {batch(evaluate), batch(pdf), batch(sample), single(evaluate), single(pdf), single(sample)}};
}

/// Of surfaces' materials.
std::vector<Row> rows_of(const std::vector<std::string>& texts) {
  std::vector<Row> all;
  for (const std::string& text : texts) all.push_back(row_of<Surface>(text, make(text, false)));
  return all;
}

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const vm::Builtin& row : materials::rows()) {
    const bool volume =
        (materials::traits(materials::Lobe(row.lobe)) & materials::PhaseFunction) != 0;
    const Made made = make(row.example, volume);
    all.push_back(volume ? row_of<materials::Phase>(row.example, made)
                         : row_of<Surface>(row.example, made));
  }
  for (Row& variant : rows_of({std::begin(kVariants), std::end(kVariants)}))
    all.push_back(std::move(variant));
  return all;
}

std::string table_of(const std::vector<Row>& all) {
  // All materials in every round, so that a machine whose speed changes is the same to each.
  std::vector<std::function<void()>> calls;
  for (const Row& r : all) calls.insert(calls.end(), r.calls.begin(), r.calls.end());
  const std::vector<Series> times = interleave(calls, kHits, kRounds);
  std::string table =
      "| material | evaluate | pdf | sample | evaluate alone | pdf alone | sample alone | error, "
      "median | error, 999 of 1000 |\n|---|---|---|---|---|---|---|---|---|\n";
  std::size_t column = 0;
  for (const Row& r : all) {
    table += fmt::format("| `{}` |", r.text);
    for (std::size_t k = 0; k < r.calls.size(); ++k)
      table += fmt::format(" {:.0f} |", median(times[column++]));
    table += r.errors.empty()
                 ? " | |\n"
                 : fmt::format(" {:.1f} | {:.0f} |\n", median(r.errors), quantile(r.errors, 0.999));
  }
  return table;
}

std::string document() {
  const std::string table = table_of(rows());
  return fmt::format(
      "## Materials, ns a hit\n\nAll eight wavelengths of a hit in float, the choice among parts "
      "included: the median of {} rounds, of all\nmaterials in turn, over {} hits, half of whose "
      "directions are the model's own samples. First as the renderer calls\nthem, hit after hit "
      "with numbers of its own; then `alone`, where each call waits for the one before. What "
      "coats, rough metal\nand rough glass are along all directions is kept from hit to hit, as "
      "along paths. `error` is how far f in float is from f in\ndouble at the same numbers, in "
      "units of 2^-24 of it; of models that are ideally "
      "specular, so are weights of samples. `./run bench`, or `bench_materials` alone. {}, load "
      "average {}.\n\n{}",
      kRounds, kHits, processor(), load(), table);
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  using namespace mms::bench;
  if (count > 1 && arguments[1][0] != '-') {
    fmt::print("{}", table_of(rows_of({arguments + 1, arguments + count})));
    return 0;
  }
  return part_main(count, arguments, "materials", document);
}
